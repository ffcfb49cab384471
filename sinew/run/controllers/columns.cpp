#include "sinew/run/controllers/columns.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "sinew/control/setup/joint_controllers.h"
#include "sinew/experiment/faults.h"
#include "sinew/robot/legs.h"

namespace sinew::run {
namespace {

using signals::Topic;

// A list to which columns are appended.
class Columns {
 public:
  // Adds a column of one field.
  template <class Value>
  void scalar(std::string name, std::string unit, std::string description, Value value) {
    list.push_back({{std::move(name), std::move(description), {{"value", std::move(unit)}}},
                    [value](const Snapshot& m, double* out) { *out = value(m); }});
  }

  // Adds a column of the fields x and y.
  template <class Value>
  void vector(std::string name, std::string unit, std::string description, Value value) {
    list.push_back({{std::move(name), std::move(description), {{"x", unit}, {"y", unit}}},
                    [value](const Snapshot& m, double* out) { value(m, out[0], out[1]); }});
  }

  // Adds a column of a true value of the robot or of the stand, or of element i of an array.
  template <class Part, class Value>
  Column& truth(std::string name, std::string unit, std::string description, Value Part::*value,
                std::size_t i = 0) {
    scalar(std::move(name), std::move(unit), std::move(description), [=](const Snapshot& m) {
      const auto& its = part<Part>(*m.true_of).*value;
      if constexpr (std::is_same_v<Value, double>)
        return its;
      else
        return its[i];
    });
    return list.back();
  }

  std::vector<Column> list;

 private:
  template <class Part>
  static const Part& part(const plant::Truths& all) {
    if constexpr (std::is_same_v<Part, plant::StandTruth>)
      return all.stand;
    else
      return all.robot;
  }
};

// A leg and its number, as needed by its columns.
struct LegAt {
  std::size_t leg = 0;
  robot::LegParts parts;

  // Returns the leg's topic of that name.
  std::string topic(const std::string& name) const { return robot::topic_of_leg(parts.name, name); }
};

// Returns the legs in the robot's order.
std::vector<LegAt> legs_at(const robot::Robot& robot) {
  std::vector<LegAt> out;
  for (robot::LegParts& parts : robot::legs_of(robot))
    out.push_back({out.size(), std::move(parts)});
  return out;
}

// Returns whether the cylinder moves the body up and down.
bool moves(const robot::Cylinder& c) {
  return c.present && c.mode != robot::Cylinder::Mode::locked;
}

// A joint's leg, and its number in that leg.
struct JointAt {
  std::size_t leg = 0, joint = 0;
};

// Returns the place of a joint. A joint that belongs to no leg gets the first place of the first
// leg: it has no sensor and no setpoint.
JointAt place_of(const robot::Robot& robot, std::size_t joint) {
  for (const LegAt& leg : legs_at(robot))
    for (std::size_t i = 0; i < leg.parts.joints.size(); ++i)
      if (leg.parts.joints[i] == static_cast<int>(joint)) return {leg.leg, i};
  return {};
}

// Adds the columns that hardware logs as well, joint by joint.
void joint_columns(const robot::Robot& robot, Columns& out) {
  for (std::size_t s = 0; s < robot.sensors.size(); ++s)
    out.scalar("/sensor/" + robot.sensors[s].name + "/count", "count", "as converted",
               [s](const Snapshot& m) { return m.controller->supervised(s).counts; });
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    if (robot::angle_sensor_of(robot, static_cast<int>(j)) < 0) continue;
    const std::string at = robot::topic_of_joint(robot, j), want = "/desired" + at;
    const JointAt at_leg = place_of(robot, j);
    const std::size_t leg = at_leg.leg, i = at_leg.joint;
    out.scalar(at + "/angle", "rad", "measured, by the controller's scale",
               [j](const Snapshot& m) { return m.measured->angle[j]; });
    out.scalar(at + "/stiffness", "N m/rad", "as the controller computes it, [27], [60]",
               [j](const Snapshot& m) { return m.measured->stiffness[j]; });
    out.scalar(at + "/velocity_estimate", "rad/s", "what the velocity gain works on, 6.5",
               [j](const Snapshot& m) { return m.measured->velocity[j]; });
    out.scalar(want + "/angle", "rad", "desired by the gait controller",
               [=](const Snapshot& m) { return m.desired[leg].joint[i].angle; });
    out.scalar(want + "/stiffness", "N m/rad", "desired by the gait controller",
               [=](const Snapshot& m) { return m.desired[leg].joint[i].stiffness; });
  }
}

// Adds a muscle's tension: counts of its gauge, converted by the gauge's own scale.
void tension_column(const robot::Robot& robot, std::size_t muscle, Columns& out) {
  const int s = robot::tension_sensor_of(robot, static_cast<int>(muscle));
  if (s < 0) return;
  const auto channel = static_cast<std::size_t>(s);
  const robot::SensorLine line = robot::own_tension(robot.sensors[channel], robot.converter);
  out.scalar(robot::topic_of_muscle(robot, muscle) + "/tension", "N",
             "measured, by its own transducer's scale; clips",
             [=](const Snapshot& m) { return line.value(m.controller->reading(channel).counts); });
}

// Returns whether a joint's duties act: its valves switch only while it is enabled and the laws
// run.
bool active(const Snapshot& m, std::size_t joint) {
  return m.controller->joint(joint).enabled && m.controller->phase == control::Phase::running;
}

// Returns whether a muscle has duties. A regulator has none; its set points are in the log of its
// edges.
bool has_duty(const experiment::Experiment& e, const robot::Muscle& muscle) {
  for (const gas::Valve& v : e.valves)
    if (v.name == muscle.inlet) return v.kind != gas::Valve::Kind::regulator;
  return true;
}

void duty_columns(const robot::Robot& robot, std::size_t index, Columns& out) {
  const robot::Muscle& muscle = robot.muscles[index];
  const std::string at = robot::topic_of_muscle(robot, index);
  const auto j = static_cast<std::size_t>(robot::find_joint(robot, muscle.joint));
  const int second = robot::find_joint(robot, muscle.second.joint);
  const auto other = second < 0 ? j : static_cast<std::size_t>(second);
  const bool flexor = muscle.role == robot::Muscle::Role::flexor;
  const auto share = [j, other](const Snapshot& m, std::int32_t percent) {
    return active(m, j) || active(m, other) ? 0.01 * percent : 0.0;
  };
  out.scalar(at + "/inlet_duty", "1", "commanded share of the period", [=](const Snapshot& m) {
    const control::Duties& d = m.controller->joint(j).duties;
    return share(m, flexor ? d.flexor_inlet : d.extensor_inlet);
  });
  out.scalar(at + "/exhaust_duty", "1", "commanded share of the period", [=](const Snapshot& m) {
    const control::Duties& d = m.controller->joint(j).duties;
    return share(m, flexor ? d.flexor_exhaust : d.extensor_exhaust);
  });
}

void muscle_columns(const experiment::Experiment& e, Columns& out) {
  for (std::size_t i = 0; i < e.robot.muscles.size(); ++i) {
    tension_column(e.robot, i, out);
    if (has_duty(e, e.robot.muscles[i])) duty_columns(e.robot, i, out);
  }
}

// Up is the flexor, in the low level, of the joint that follows the robot's own.
void cylinder_columns(const robot::Robot& robot, Columns& out) {
  if (!robot::has_cylinder_joint(robot)) return;
  const std::size_t j = robot.joints.size();
  out.scalar("/cylinder/position", "m", "measured travel, up from the extended stop",
             [](const Snapshot& m) { return m.measured->cylinder; });
  out.scalar("/desired/cylinder/position", "m", "by the plan, up from the extended stop",
             [](const Snapshot& m) { return m.desired[0].cylinder.position; });
  const auto duty = [&](const char* name, std::int32_t control::Duties::*which) {
    out.scalar(std::string("/cylinder/") + name, "1", "commanded share of the period",
               [j, which](const Snapshot& m) {
                 return active(m, j) ? 0.01 * (m.controller->joint(j).duties.*which) : 0.0;
               });
  };
  duty("up/inlet_duty", &control::Duties::flexor_inlet);
  duty("up/exhaust_duty", &control::Duties::flexor_exhaust);
  duty("down/inlet_duty", &control::Duties::extensor_inlet);
  duty("down/exhaust_duty", &control::Duties::extensor_exhaust);
}

void low_level_columns(const robot::Robot& robot, Columns& out) {
  if (!control::laws_overrun(robot)) return;
  out.scalar("/low_level/overruns", "1", "laws so far that took longer than their interrupt may",
             [](const Snapshot& m) { return m.controller->overruns(); });
}

// Returns whether rejected readings are worth recording: the experiment has a fault, or the robot's
// file has a limit.
bool is_supervised_closely(const experiment::Experiment& e) {
  return !e.faults.empty() || std::isfinite(e.robot.low_level.command_rate) ||
         std::ranges::any_of(e.robot.sensors, [](const robot::Sensor& s) {
           return !s.plausible.empty() || std::isfinite(s.max_rate) ||
                  std::isfinite(s.frozen_limit);
         });
}

// Adds the counters of rejected readings if the experiment gives reason to expect some.
void supervision_columns(const experiment::Experiment& e, Columns& out) {
  if (!is_supervised_closely(e)) return;
  for (std::size_t s = 0; s < e.robot.sensors.size(); ++s) {
    const std::string at = "/sensor/" + e.robot.sensors[s].name;
    out.scalar(at + "/rejected", "1", "readings so far that were not accepted",
               [s](const Snapshot& m) { return m.controller->supervised(s).rejected; });
    out.scalar(at + "/frozen", "1", "readings so far that repeated themselves while driven",
               [s](const Snapshot& m) { return m.controller->supervised(s).frozen; });
  }
  out.scalar("/low_level/rejected_commands", "1", "commands so far that were not followed",
             [](const Snapshot& m) { return m.controller->rejected_commands(); });
  out.scalar("/low_level/gaps", "1", "ticks so far that came later than announced",
             [](const Snapshot& m) { return m.controller->gaps(); });
  out.scalar("/low_level/tripped", "1", "1 from when the supervisor has ended the run",
             [](const Snapshot& m) { return m.controller->tripped() ? 1.0 : 0.0; });
}

// Returns when a foot has a setpoint: only in phases that give it a path, and only if it belongs to
// a leg.
Column::Given foot_given(const experiment::Experiment& e) {
  const bool has_path =
      std::ranges::any_of(e.plan.phases, [](const gait::Phase& p) { return p.has_path(); });
  return has_path ? Column::Given::at_times : Column::Given::never;
}

void plan_columns(const experiment::Experiment& e, const LegAt& leg, Columns& out) {
  const std::size_t l = leg.leg;
  out.scalar(leg.topic("/plan/phase"), "1", "position in the experiment's phases; -1 outside",
             [l](const Snapshot& m) { return m.desired[l].phase; });
  out.scalar(leg.topic("/plan/step"), "1", "counts from 0",
             [l](const Snapshot& m) { return m.desired[l].step; });
  out.scalar(leg.topic("/plan/unreachable"), "1", "1 while the nearest reachable point is held",
             [l](const Snapshot& m) { return m.desired[l].unreachable ? 1.0 : 0.0; });
  out.vector(leg.topic("/desired/foot/position"), "m", "about the first joint; none: not a number",
             [l](const Snapshot& m, double& x, double& y) {
               const gait::Desired& desired = m.desired[l];
               x = desired.has_foot ? desired.foot.x : std::nan("");
               y = desired.has_foot ? desired.foot.y : std::nan("");
             });
  out.list.back().given = foot_given(e);
}

// Adds the gains as phases, profiles and changes have set them.
void gain_columns(const experiment::Experiment& e, const LegAt& leg, Columns& out) {
  if (!e.log.gains) return;
  for (const gait::Setting& s : gait::settings(e.plan)) {
    constexpr std::string_view before = "control.gains.";
    if (!s.key.starts_with(before)) continue;  // desired angles and stiffnesses are always logged
    std::string name = leg.topic("/desired/gain/" + s.key.substr(before.size()));
    std::ranges::replace(name, '.', '/');
    out.scalar(std::move(name), std::string(s.unit), "in effect",
               [s, l = leg.leg](const Snapshot& m) { return gait::value_of(s, m.desired[l]); });
  }
}

// --- columns that only a simulation can provide ---

using T = plant::Truth;

void true_joint_columns(const robot::Robot& robot, Columns& out) {
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const std::string at = "/true" + robot::topic_of_joint(robot, j);
    out.truth(at + "/angle", "rad", "of the simulated joint", &T::angle, j).is_of_motion = true;
    out.truth(at + "/velocity", "rad/s", "of the simulated joint", &T::rate, j).is_of_motion = true;
    out.truth(at + "/torque", "N m", "of its muscles", &T::torque, j);
  }
}

// Returns whether a muscle leaks, by its description or by a fault.
bool leaks(const experiment::Experiment& e, const robot::Muscle& m) {
  using What = experiment::Fault::What;
  return m.leak.area > 0 || m.leak.conductance > 0 ||
         std::ranges::any_of(e.faults, [&](const experiment::Fault& f) {
           return f.of == m.name && (f.what == What::leaking || f.what == What::ruptured);
         });
}

void true_muscle_columns(const experiment::Experiment& e, Columns& out) {
  const robot::Robot& robot = e.robot;
  for (std::size_t i = 0; i < robot.muscles.size(); ++i) {
    const std::string at = "/true" + robot::topic_of_muscle(robot, i);
    out.truth(at + "/tension", "N", "in the tendon", &T::tension, i);
    out.truth(at + "/pressure", "Pa", "absolute", &T::pressure, i);
    out.truth(at + "/length", "m", "of the actuators", &T::length, i);
    out.truth(at + "/mass", "kg", "of the air in the bundle", &T::mass, i);
    out.truth(at + "/air_in", "kg", "from the supply since the start", &T::air_in, i);
    out.truth(at + "/air_out", "kg", "to the atmosphere since the start", &T::air_out, i);
    if (leaks(e, robot.muscles[i]))
      out.truth(at + "/air_leaked", "kg", "to the atmosphere, past the valves, since the start",
                &T::air_leaked, i);
  }
}

// Adds the mass of all the machine's air, for its balance, if a part of the air can fail or a hose
// holds air in addition to the muscles.
void true_air_columns(const experiment::Experiment& e, Columns& out) {
  const bool breaks = !std::ranges::all_of(
      e.faults, [](const experiment::Fault& f) { return is_of_sensor(f.what); });
  const bool in_hoses = std::ranges::any_of(e.robot.muscles, [](const robot::Muscle& m) {
    return m.hose.law != gas::Hose::Law::none && m.hose.volume > 0;
  });
  if (!breaks && !in_hoses) return;
  out.truth("/true/air/mass", "kg", "in chambers, hoses and tank", &T::air_mass);
  const bool fails = std::ranges::any_of(e.faults, [](const experiment::Fault& f) {
    return f.what == experiment::Fault::What::failed;
  });
  if (fails && e.supply.kind == gas::Supply::Kind::tank)
    out.truth("/true/supply/air_past_tank", "kg",
              "from the line while a fault had cut it from its tank, since the start",
              &T::air_past_tank);
}

void true_supply_columns(const gas::Supply& supply, Columns& out) {
  if (supply.kind != gas::Supply::Kind::tank) return;
  out.truth("/true/supply/pressure", "Pa", "of the line to the inlets, absolute",
            &T::supply_pressure);
  out.truth("/true/supply/tank_pressure", "Pa", "before the regulator, absolute",
            &T::tank_pressure);
}

// `disc` counts the discs of all feet.
void true_foot_columns(const robot::Robot& robot, const LegAt& leg, std::size_t& disc,
                       Columns& out) {
  const robot::Foot& foot = robot::foot_of(robot, leg.leg);
  const std::size_t l = leg.leg;
  if (!foot.present) return;
  out.vector(leg.topic("/true/foot/position"), "m", "of the ankle, about the first joint",
             [l](const Snapshot& m, double& x, double& y) {
               x = m.true_of->robot.foot[l].x;
               y = m.true_of->robot.foot[l].y;
             });
  out.vector(leg.topic("/true/foot/force"), "N", "on the foot, by the ground",
             [l](const Snapshot& m, double& x, double& y) {
               x = m.true_of->robot.foot[l].force_x;
               y = m.true_of->robot.foot[l].force_y;
             });
  for (const robot::Foot::Point& point : foot.points)
    out.truth(leg.topic("/true/foot/" + point.name + "/load"), "N", "of the ground, up",
              &T::disc_force, disc++);
  if (foot.points.empty()) ++disc;
}

void true_body_columns(const robot::Robot& robot, Columns& out) {
  if (robot.trolley.present) {
    out.truth("/true/trolley/position", "m", "along the track", &T::x).is_of_motion = true;
    out.truth("/true/trolley/velocity", "m/s", "along the track", &T::x_rate).is_of_motion = true;
  }
  std::size_t disc = 0;
  for (const LegAt& leg : legs_at(robot)) true_foot_columns(robot, leg, disc, out);
  if (!robot.rollers.present) return;
  out.truth("/true/roller/front/load", "N", "below 0: it has lifted off", &T::roller_front);
  out.truth("/true/roller/rear/load", "N", "below 0: it has lifted off", &T::roller_rear);
}

void true_cylinder_columns(const robot::Robot& robot, Columns& out) {
  if (!moves(robot.cylinder)) return;
  out.truth("/true/cylinder/position", "m", "up from the extended stop", &T::lift);
  out.truth("/true/cylinder/velocity", "m/s", "upwards", &T::lift_rate);
  if (robot.cylinder.mode == robot::Cylinder::Mode::free) return;
  for (const auto& [name, c] :
       {std::pair{"up", std::size_t{0}}, std::pair{"down", std::size_t{1}}}) {
    const std::string at = std::string("/true/cylinder/") + name;
    out.truth(at + "/pressure", "Pa", "absolute", &T::cylinder_pressure, c);
    out.truth(at + "/air_in", "kg", "from the supply since the start", &T::cylinder_in, c);
    out.truth(at + "/air_out", "kg", "to the atmosphere since the start", &T::cylinder_out, c);
  }
}

void true_fault_columns(const experiment::Experiment& e, Columns& out) {
  for (const experiment::FaultsOfPart& part : experiment::by_part(e.faults)) {
    if (is_of_sensor(part.faults.front().what))
      out.scalar(part.topic, "1", "1 while one of the experiment's acts on it",
                 [part](const Snapshot& m) { return part.acted(m.time, 0); });
    else
      out.scalar(
          part.topic, "1", experiment::fault_description,
          [part, period = e.log.period](const Snapshot& m) { return part.acted(m.time, period); });
  }
}

void true_columns(const experiment::Experiment& e, Columns& out) {
  true_joint_columns(e.robot, out);
  true_muscle_columns(e, out);
  true_body_columns(e.robot, out);
  true_cylinder_columns(e.robot, out);
  true_air_columns(e, out);
  true_supply_columns(e.supply, out);
  true_fault_columns(e, out);
}

// --- columns of a test stand ---

using experiment::Stand;

bool has_law(const Stand& s) {
  return s.drive.kind == Stand::Drive::Kind::feed_forward ||
         s.drive.kind == Stand::Drive::Kind::feedback;
}

std::string unit_of(robot::Transducer::Of of) {
  using Of = robot::Transducer::Of;
  return of == Of::length ? "m" : of == Of::force ? "N" : of == Of::pressure ? "Pa" : "m/s^2";
}

void measured_columns(const Stand& stand, Columns& out) {
  for (std::size_t s = 0; s < stand.sensors.size(); ++s) {
    const robot::Transducer& t = stand.sensors[s];
    out.scalar("/sensor/" + t.name + "/count", "count", "as converted",
               [s](const Snapshot& m) { return double(m.controller->reading(s).counts); });
    out.scalar(
        "/sensor/" + t.name + "/value", unit_of(t.of), "by its own scale; pressure is gauge",
        [s, t](const Snapshot& m) { return robot::quantity(t, m.controller->reading(s).counts); });
  }
  if (has_law(stand))
    out.scalar("/desired/length", "m", "of the element",
               [](const Snapshot& m) { return m.drive->setpoint().length; });
  if (!has_law(stand) && stand.drive.kind != Stand::Drive::Kind::pwm) return;
  const std::string at = "/muscle/" + stand.element.name;
  out.scalar(at + "/inlet_duty", "1", "commanded share of the period",
             [](const Snapshot& m) { return m.drive->shares().inlet; });
  if (!stand.element.exhaust.empty())
    out.scalar(at + "/exhaust_duty", "1", "commanded share of the period",
               [](const Snapshot& m) { return m.drive->shares().exhaust; });
}

void true_stand_columns(const experiment::Experiment& e, Columns& out) {
  using S = plant::StandTruth;
  const Stand& stand = *e.stand;
  out.truth("/true/stand/length", "m", "of the element, grows as it is pulled", &S::length);
  out.truth("/true/stand/velocity", "m/s", "of its length", &S::velocity);
  out.truth("/true/stand/acceleration", "m/s^2", "of its length", &S::acceleration);
  out.truth("/true/stand/force", "N", "of the element on the load, dry friction in it", &S::force);
  out.truth("/true/stand/friction", "N", "dry part of the force", &S::friction);
  if (stand.load.mode == robot::Stand::Load::Mode::hanging)
    out.truth("/true/stand/mass", "kg", "that hangs", &S::load);
  const std::string& name = stand.element.name;
  const std::string at = "/true/muscle/" + name;
  out.truth(at + "/pressure", "Pa", "absolute", &S::pressure);
  out.truth(at + "/mass", "kg", "of its air", &S::air);
  out.truth(at + "/air_in", "kg", "since the start", &S::air_in);
  out.truth(at + "/air_out", "kg", "since the start", &S::air_out);
  out.truth(at + "/air_leaked", "kg", "since the start", &S::air_leaked);
  if (stand.element.hose.law != gas::Hose::Law::none && stand.element.hose.volume > 0)
    out.truth("/true/air/mass", "kg", "in element, hose and tank", &S::all_air);
  if (stand.charge.mode == robot::Stand::Charge::Mode::valves) {
    out.truth("/true/valve/" + name + "/inlet", "1", "open share of its area", &S::inlet);
    out.truth("/true/valve/" + name + "/exhaust", "1", "open share of its area", &S::exhaust);
    out.truth("/true/supply/pressure", "Pa", "of the line, absolute", &S::supply_pressure);
  }
  if (e.supply.kind == gas::Supply::Kind::tank)
    out.truth("/true/supply/tank_pressure", "Pa", "absolute", &S::tank_pressure);
}

void stand_columns(const experiment::Experiment& e, Columns& out) {
  measured_columns(*e.stand, out);
  true_stand_columns(e, out);
  true_fault_columns(e, out);
}

}  // namespace

std::vector<Column> columns(const experiment::Experiment& e) {
  Columns out;
  if (e.stand) {
    stand_columns(e, out);
    return std::move(out.list);
  }
  joint_columns(e.robot, out);
  muscle_columns(e, out);
  cylinder_columns(e.robot, out);
  low_level_columns(e.robot, out);
  supervision_columns(e, out);
  for (const LegAt& leg : legs_at(e.robot)) {
    plan_columns(e, leg, out);
    gain_columns(e, leg, out);
  }
  true_columns(e, out);
  return std::move(out.list);
}

namespace {

std::vector<Topic> topics_of_sweep() {
  return {{"/sweep/duty", "commanded, one stand each", {{"value", "1"}}},
          {"/true/sweep/length", "mean of the last five periods", {{"value", "m"}}},
          {"/true/sweep/ripple", "of the length in them", {{"value", "m"}}},
          {"/true/sweep/pressure", "mean, absolute", {{"value", "Pa"}}},
          {"/true/sweep/force", "mean, on the load", {{"value", "N"}}}};
}

}  // namespace

std::vector<Topic> topics(const experiment::Experiment& e) { return topics(e, columns(e)); }

std::vector<Topic> topics(const experiment::Experiment& e, std::span<const Column> columns) {
  if (e.stand && e.stand->sweep.step > 0) return topics_of_sweep();
  std::vector<Topic> out;
  out.reserve(columns.size() + 2 * e.robot.muscles.size() + 4);
  for (const Column& c : columns) out.push_back(c.topic);
  const auto valve = [&](const std::string& valves, const char* which) {
    out.push_back(
        {valves + "/" + which + "/open", "electrical edges: 1 opens, 0 shuts", {{"value", "1"}}});
  };
  if (e.stand && e.stand->charge.mode == robot::Stand::Charge::Mode::valves) {
    valve("/valve/" + e.stand->element.name, "inlet");
    if (!e.stand->element.exhaust.empty()) valve("/valve/" + e.stand->element.name, "exhaust");
  }
  for (std::size_t i = 0; i < e.robot.muscles.size(); ++i) {
    const std::string valves = robot::topic_of_valves(e.robot, i);
    valve(valves, "inlet");
    if (!has_duty(e, e.robot.muscles[i]))
      out.back() = {valves + "/inlet/set_point",
                    "of the regulator, as a share of its range",
                    {{"value", "1"}}};
    valve(valves, "exhaust");
  }
  if (e.robot.cylinder.present && e.robot.cylinder.mode == robot::Cylinder::Mode::valves)
    for (const char* chamber : {"/valve/cylinder_up", "/valve/cylinder_down"})
      for (const char* which : {"inlet", "exhaust"}) valve(chamber, which);
  return out;
}

}  // namespace sinew::run
