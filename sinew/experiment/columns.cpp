#include "sinew/experiment/columns.h"

#include <algorithm>
#include <cmath>

#include "sinew/experiment/spinal.h"
#include "sinew/experiment/supervision.h"

namespace sinew::experiment {
namespace {

using signals::Topic;

class Columns {
 public:
  template <class Value>
  void scalar(std::string name, std::string unit, std::string description, Value value) {
    list.push_back({{std::move(name), std::move(description), {{"value", std::move(unit)}}},
                    [value](const Moment& m, double* out) { *out = value(m); }});
  }

  template <class Value>
  void vector(std::string name, std::string unit, std::string description, Value value) {
    list.push_back({{std::move(name), std::move(description), {{"x", unit}, {"y", unit}}},
                    [value](const Moment& m, double* out) { value(m, out[0], out[1]); }});
  }

  std::vector<Column> list;
};

bool moves(const robot::Cylinder& c) {
  return c.present && c.mode != robot::Cylinder::Mode::locked;
}

// What hardware would log as well, joint by joint.
void joint_columns(const robot::Robot& robot, Columns& out) {
  for (std::size_t s = 0; s < robot.sensors.size(); ++s)
    out.scalar("/sensor/" + robot.sensors[s].name + "/count", "count", "as converted",
               [s](const Moment& m) { return m.supervised.sensor[s].counts; });
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    if (robot::angle_sensor_of(robot, static_cast<int>(j)) < 0) continue;
    const std::string& name = robot.joints[j].name;
    const std::string at = "/joint/" + name, want = "/desired/joint/" + name;
    out.scalar(at + "/angle", "rad", "measured, by the controller's scale",
               [j](const Moment& m) { return m.measured.angle[j]; });
    out.scalar(at + "/stiffness", "N m/rad", "as the controller believes it, [27], [60]",
               [j](const Moment& m) { return m.measured.stiffness[j]; });
    out.scalar(at + "/velocity_estimate", "rad/s", "what the velocity gain works on, 6.5",
               [j](const Moment& m) { return m.measured.velocity[j]; });
    out.scalar(want + "/angle", "rad", "desired by the brain",
               [j](const Moment& m) { return m.desired.joint[j].angle; });
    out.scalar(want + "/stiffness", "N m/rad", "desired by the brain",
               [j](const Moment& m) { return m.desired.joint[j].stiffness; });
  }
}

// A gauge's counts by its own scale.
void tension_column(const robot::Robot& robot, std::size_t muscle, Columns& out) {
  const int s = robot::tension_sensor_of(robot, static_cast<int>(muscle));
  if (s < 0) return;
  const robot::Sensor& sensor = robot.sensors[static_cast<std::size_t>(s)];
  const double per_volt = robot.converter.counts_per_volt();
  const double believed = 1.0 / (sensor.assumed_scale * per_volt);
  const double own = 1.0 / (sensor.scale * per_volt);
  out.scalar("/muscle/" + robot.muscles[muscle].name + "/tension", "N",
             "measured, by its own transducer's scale; clips",
             [=](const Moment& m) { return m.measured.tension[muscle] / believed * own; });
}

// What a valve is told counts only while its joint is enabled and laws run.
bool active(const Moment& m, std::size_t joint) {
  return m.seen.joint[joint].enabled && m.seen.phase == control::Phase::running;
}

// A regulator has no duty; its set points are in the log of its edges.
bool has_duty(const Experiment& e, const robot::Muscle& muscle) {
  for (const gas::Valve& v : e.valves)
    if (v.name == muscle.inlet) return v.kind != gas::Valve::Kind::regulator;
  return true;
}

void duty_columns(const robot::Robot& robot, const robot::Muscle& muscle, Columns& out) {
  const std::string at = "/muscle/" + muscle.name;
  const auto j = static_cast<std::size_t>(robot::find_joint(robot, muscle.joint));
  const int second = robot::find_joint(robot, muscle.second.joint);
  const auto other = second < 0 ? j : static_cast<std::size_t>(second);
  const bool flexor = muscle.role == robot::Muscle::Role::flexor;
  const auto share = [j, other](const Moment& m, std::int32_t percent) {
    return active(m, j) || active(m, other) ? 0.01 * percent : 0.0;
  };
  out.scalar(at + "/inlet_duty", "1", "commanded share of the period", [=](const Moment& m) {
    const control::Duties& d = m.seen.joint[j].duties;
    return share(m, flexor ? d.flexor_inlet : d.extensor_inlet);
  });
  out.scalar(at + "/exhaust_duty", "1", "commanded share of the period", [=](const Moment& m) {
    const control::Duties& d = m.seen.joint[j].duties;
    return share(m, flexor ? d.flexor_exhaust : d.extensor_exhaust);
  });
}

void muscle_columns(const Experiment& e, Columns& out) {
  for (std::size_t i = 0; i < e.robot.muscles.size(); ++i) {
    tension_column(e.robot, i, out);
    if (has_duty(e, e.robot.muscles[i])) duty_columns(e.robot, e.robot.muscles[i], out);
  }
}

// Up is the low level's flexor of the joint behind the robot's own.
void cylinder_columns(const robot::Robot& robot, Columns& out) {
  if (!has_cylinder_joint(robot)) return;
  const std::size_t j = robot.joints.size();
  out.scalar("/cylinder/position", "m", "measured travel, up from the extended stop",
             [](const Moment& m) { return m.measured.cylinder; });
  out.scalar("/desired/cylinder/position", "m", "by the plan, up from the extended stop",
             [](const Moment& m) { return m.desired.cylinder.position; });
  const auto duty = [&](const char* name, std::int32_t control::Duties::*which) {
    out.scalar(std::string("/cylinder/") + name, "1", "commanded share of the period",
               [j, which](const Moment& m) {
                 return active(m, j) ? 0.01 * (m.seen.joint[j].duties.*which) : 0.0;
               });
  };
  duty("up/inlet_duty", &control::Duties::flexor_inlet);
  duty("up/exhaust_duty", &control::Duties::flexor_exhaust);
  duty("down/inlet_duty", &control::Duties::extensor_inlet);
  duty("down/exhaust_duty", &control::Duties::extensor_exhaust);
}

void low_level_columns(const robot::Robot& robot, Columns& out) {
  if (!laws_overrun(robot)) return;
  out.scalar("/low_level/overruns", "1", "laws so far that took longer than their interrupt may",
             [](const Moment& m) { return m.seen.overruns; });
}

// Adds the counters of rejected readings where the experiment gives reason to expect some.
void supervision_columns(const Experiment& e, Columns& out) {
  if (!is_supervised_closely(e)) return;
  for (std::size_t s = 0; s < e.robot.sensors.size(); ++s) {
    const std::string at = "/sensor/" + e.robot.sensors[s].name;
    out.scalar(at + "/rejected", "1", "readings so far that were not believed",
               [s](const Moment& m) { return m.supervised.sensor[s].rejected; });
    out.scalar(at + "/frozen", "1", "readings so far that repeated themselves while driven",
               [s](const Moment& m) { return m.supervised.sensor[s].frozen; });
  }
  out.scalar("/low_level/rejected_commands", "1", "commands so far that were not followed",
             [](const Moment& m) { return m.supervised.rejected_commands; });
  out.scalar("/low_level/gaps", "1", "ticks so far that came later than announced",
             [](const Moment& m) { return m.supervised.gaps; });
  out.scalar("/low_level/tripped", "1", "1 from when the supervisor has ended the run",
             [](const Moment& m) {
               return m.supervised.trip.cause == control::Trip::Cause::none ? 0.0 : 1.0;
             });
}

void plan_columns(Columns& out) {
  out.scalar("/plan/phase", "1", "position in the experiment's phases; -1 outside",
             [](const Moment& m) { return m.desired.phase; });
  out.scalar("/plan/step", "1", "counts from 0", [](const Moment& m) { return m.desired.step; });
  out.scalar("/plan/unreachable", "1", "1 while the nearest reachable point is held",
             [](const Moment& m) { return m.desired.unreachable ? 1.0 : 0.0; });
  out.vector("/desired/foot/position", "m", "about the first joint; none: not a number",
             [](const Moment& m, double& x, double& y) {
               x = m.desired.has_foot ? m.desired.foot.x : std::nan("");
               y = m.desired.has_foot ? m.desired.foot.y : std::nan("");
             });
}

// As phases, profiles and changes have made them.
void gain_columns(const Experiment& e, Columns& out) {
  if (!e.log.gains) return;
  for (const gait::Setting& s : gait::settings(e.plan)) {
    constexpr std::string_view before = "control.gains.";
    if (!s.key.starts_with(before)) continue;  // desired angles and stiffnesses are always there
    std::string name = "/desired/gain/" + s.key.substr(before.size());
    std::ranges::replace(name, '.', '/');
    out.scalar(std::move(name), std::string(s.unit), "in effect",
               [s](const Moment& m) { return gait::value_of(s, m.desired); });
  }
}

void true_joint_columns(const robot::Robot& robot, Columns& out) {
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const std::string at = "/true/joint/" + robot.joints[j].name;
    out.scalar(at + "/angle", "rad", "of the simulated joint",
               [j](const Moment& m) { return m.truth.angle[j]; });
    out.scalar(at + "/velocity", "rad/s", "of the simulated joint",
               [j](const Moment& m) { return m.truth.rate[j]; });
    out.scalar(at + "/torque", "N m", "of its muscles",
               [j](const Moment& m) { return m.truth.torque[j]; });
  }
}

void true_muscle_columns(const robot::Robot& robot, Columns& out) {
  for (std::size_t i = 0; i < robot.muscles.size(); ++i) {
    const std::string at = "/true/muscle/" + robot.muscles[i].name;
    out.scalar(at + "/tension", "N", "at the cord",
               [i](const Moment& m) { return m.truth.tension[i]; });
    out.scalar(at + "/pressure", "Pa", "absolute",
               [i](const Moment& m) { return m.truth.pressure[i]; });
    out.scalar(at + "/length", "m", "of the actuators",
               [i](const Moment& m) { return m.truth.length[i]; });
    out.scalar(at + "/mass", "kg", "of the air in the bundle",
               [i](const Moment& m) { return m.truth.mass[i]; });
    out.scalar(at + "/air_in", "kg", "from the supply since the start",
               [i](const Moment& m) { return m.truth.air_in[i]; });
    out.scalar(at + "/air_out", "kg", "to the atmosphere since the start",
               [i](const Moment& m) { return m.truth.air_out[i]; });
    const gas::Leak& leak = robot.muscles[i].leak;
    if (leak.area > 0 || leak.conductance > 0)
      out.scalar(at + "/air_leaked", "kg", "to the atmosphere, past the valves, since the start",
                 [i](const Moment& m) { return m.truth.air_leaked[i]; });
  }
}

// By the list [[fault]].
void true_fault_columns(const Experiment& e, Columns& out) {
  for (std::size_t s = 0; s < e.robot.sensors.size(); ++s) {
    std::vector<Fault> faults;
    for (const Fault& f : e.faults)
      if (f.of == e.robot.sensors[s].name) faults.push_back(f);
    if (faults.empty()) continue;
    out.scalar("/true/sensor/" + e.robot.sensors[s].name + "/fault", "1",
               "1 while one of the experiment's acts on it", [faults](const Moment& m) {
                 return std::ranges::any_of(faults,
                                            [&](const Fault& f) { return acts(f, m.time); });
               });
  }
}

void true_supply_columns(const gas::Supply& supply, Columns& out) {
  if (supply.kind != gas::Supply::Kind::tank) return;
  out.scalar("/true/supply/pressure", "Pa", "of the line to the inlets, absolute",
             [](const Moment& m) { return m.truth.supply_pressure; });
  out.scalar("/true/supply/tank_pressure", "Pa", "before the regulator, absolute",
             [](const Moment& m) { return m.truth.tank_pressure; });
}

void true_body_columns(const robot::Robot& robot, Columns& out) {
  if (robot.trolley.present) {
    out.scalar("/true/trolley/position", "m", "along the track",
               [](const Moment& m) { return m.truth.x; });
    out.scalar("/true/trolley/velocity", "m/s", "along the track",
               [](const Moment& m) { return m.truth.x_rate; });
  }
  if (robot.foot.present) {
    out.vector("/true/foot/position", "m", "of the ankle, about the first joint",
               [](const Moment& m, double& x, double& y) {
                 x = m.truth.foot_x;
                 y = m.truth.foot_y;
               });
    out.vector("/true/foot/force", "N", "on the foot, by the ground",
               [](const Moment& m, double& x, double& y) {
                 x = m.truth.force_x;
                 y = m.truth.force_y;
               });
  }
  for (std::size_t i = 0; i < robot.foot.points.size(); ++i)
    out.scalar("/true/foot/" + robot.foot.points[i].name + "/load", "N", "of the ground, up",
               [i](const Moment& m) { return m.truth.disc_force[i]; });
  if (!robot.rollers.present) return;
  out.scalar("/true/roller/front/load", "N", "below 0: it has lifted off",
             [](const Moment& m) { return m.truth.roller_front; });
  out.scalar("/true/roller/rear/load", "N", "below 0: it has lifted off",
             [](const Moment& m) { return m.truth.roller_rear; });
}

void true_cylinder_columns(const robot::Robot& robot, Columns& out) {
  if (!moves(robot.cylinder)) return;
  out.scalar("/true/cylinder/position", "m", "up from the extended stop",
             [](const Moment& m) { return m.truth.lift; });
  out.scalar("/true/cylinder/velocity", "m/s", "upwards",
             [](const Moment& m) { return m.truth.lift_rate; });
  for (const auto& [name, c] :
       {std::pair{"up", std::size_t{0}}, std::pair{"down", std::size_t{1}}}) {
    const std::string at = std::string("/true/cylinder/") + name;
    out.scalar(at + "/pressure", "Pa", "absolute",
               [c = c](const Moment& m) { return m.truth.cylinder_pressure[c]; });
    out.scalar(at + "/air_in", "kg", "from the supply since the start",
               [c = c](const Moment& m) { return m.truth.cylinder_in[c]; });
    out.scalar(at + "/air_out", "kg", "to the atmosphere since the start",
               [c = c](const Moment& m) { return m.truth.cylinder_out[c]; });
  }
}

}  // namespace

std::vector<Column> columns(const Experiment& e) {
  Columns out;
  joint_columns(e.robot, out);
  muscle_columns(e, out);
  cylinder_columns(e.robot, out);
  low_level_columns(e.robot, out);
  supervision_columns(e, out);
  plan_columns(out);
  gain_columns(e, out);
  true_joint_columns(e.robot, out);
  true_muscle_columns(e.robot, out);
  true_body_columns(e.robot, out);
  true_cylinder_columns(e.robot, out);
  true_supply_columns(e.supply, out);
  true_fault_columns(e, out);
  return std::move(out.list);
}

std::vector<Topic> topics(const Experiment& e) {
  std::vector<Topic> out;
  for (Column& c : columns(e)) out.push_back(std::move(c.topic));
  const auto valve = [&](const std::string& of, const char* which) {
    out.push_back({"/valve/" + of + "/" + which + "/open",
                   "electrical edges: 1 opens, 0 shuts",
                   {{"value", "1"}}});
  };
  for (const robot::Muscle& m : e.robot.muscles) {
    valve(m.name, "inlet");
    if (!has_duty(e, m))
      out.back() = {"/valve/" + m.name + "/inlet/set_point",
                    "of the regulator, as a share of its range",
                    {{"value", "1"}}};
    valve(m.name, "exhaust");
  }
  if (e.robot.cylinder.present && e.robot.cylinder.mode == robot::Cylinder::Mode::valves)
    for (const char* chamber : {"cylinder_up", "cylinder_down"})
      for (const char* which : {"inlet", "exhaust"}) valve(chamber, which);
  return out;
}

}  // namespace sinew::experiment
