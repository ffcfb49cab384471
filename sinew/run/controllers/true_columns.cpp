// run/controllers/true_columns.cpp - columns that only a simulation can provide.
#include <algorithm>
#include <cmath>

#include "sinew/experiment/faults.h"
#include "sinew/run/controllers/column_list.h"

namespace sinew::run {
namespace {

void true_joint_columns(const robot::Robot& robot, Columns& out) {
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const std::string at = "/true" + robot::topic_of_joint(robot, j);
    out.scalar(at + "/angle", "rad", "of the simulated joint",
               [j](const Snapshot& m) { return m.true_of->robot.angle[j]; });
    out.scalar(at + "/velocity", "rad/s", "of the simulated joint",
               [j](const Snapshot& m) { return m.true_of->robot.rate[j]; });
    out.scalar(at + "/torque", "N m", "of its muscles",
               [j](const Snapshot& m) { return m.true_of->robot.torque[j]; });
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
    out.scalar(at + "/tension", "N", "in the tendon",
               [i](const Snapshot& m) { return m.true_of->robot.tension[i]; });
    out.scalar(at + "/pressure", "Pa", "absolute",
               [i](const Snapshot& m) { return m.true_of->robot.pressure[i]; });
    out.scalar(at + "/length", "m", "of the actuators",
               [i](const Snapshot& m) { return m.true_of->robot.length[i]; });
    out.scalar(at + "/mass", "kg", "of the air in the bundle",
               [i](const Snapshot& m) { return m.true_of->robot.mass[i]; });
    out.scalar(at + "/air_in", "kg", "from the supply since the start",
               [i](const Snapshot& m) { return m.true_of->robot.air_in[i]; });
    out.scalar(at + "/air_out", "kg", "to the atmosphere since the start",
               [i](const Snapshot& m) { return m.true_of->robot.air_out[i]; });
    if (leaks(e, robot.muscles[i]))
      out.scalar(at + "/air_leaked", "kg", "to the atmosphere, past the valves, since the start",
                 [i](const Snapshot& m) { return m.true_of->robot.air_leaked[i]; });
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
  out.scalar("/true/air/mass", "kg", "in chambers, hoses and tank",
             [](const Snapshot& m) { return m.true_of->robot.air_mass; });
  const bool fails = std::ranges::any_of(e.faults, [](const experiment::Fault& f) {
    return f.what == experiment::Fault::What::failed;
  });
  if (fails && e.supply.kind == gas::Supply::Kind::tank)
    out.scalar("/true/supply/air_past_tank", "kg",
               "from the line while a fault had cut it from its tank, since the start",
               [](const Snapshot& m) { return m.true_of->robot.air_past_tank; });
}

void true_supply_columns(const gas::Supply& supply, Columns& out) {
  if (supply.kind != gas::Supply::Kind::tank) return;
  out.scalar("/true/supply/pressure", "Pa", "of the line to the inlets, absolute",
             [](const Snapshot& m) { return m.true_of->robot.supply_pressure; });
  out.scalar("/true/supply/tank_pressure", "Pa", "before the regulator, absolute",
             [](const Snapshot& m) { return m.true_of->robot.tank_pressure; });
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
    out.scalar(leg.topic("/true/foot/" + point.name + "/load"), "N", "of the ground, up",
               [i = disc++](const Snapshot& m) { return m.true_of->robot.disc_force[i]; });
  if (foot.points.empty()) ++disc;
}

void true_body_columns(const robot::Robot& robot, Columns& out) {
  if (robot.trolley.present) {
    out.scalar("/true/trolley/position", "m", "along the track",
               [](const Snapshot& m) { return m.true_of->robot.x; });
    out.scalar("/true/trolley/velocity", "m/s", "along the track",
               [](const Snapshot& m) { return m.true_of->robot.x_rate; });
  }
  std::size_t disc = 0;
  for (const LegAt& leg : legs_at(robot)) true_foot_columns(robot, leg, disc, out);
  if (!robot.rollers.present) return;
  out.scalar("/true/roller/front/load", "N", "below 0: it has lifted off",
             [](const Snapshot& m) { return m.true_of->robot.roller_front; });
  out.scalar("/true/roller/rear/load", "N", "below 0: it has lifted off",
             [](const Snapshot& m) { return m.true_of->robot.roller_rear; });
}

void true_cylinder_columns(const robot::Robot& robot, Columns& out) {
  if (!moves(robot.cylinder)) return;
  out.scalar("/true/cylinder/position", "m", "up from the extended stop",
             [](const Snapshot& m) { return m.true_of->robot.lift; });
  out.scalar("/true/cylinder/velocity", "m/s", "upwards",
             [](const Snapshot& m) { return m.true_of->robot.lift_rate; });
  if (robot.cylinder.mode == robot::Cylinder::Mode::free) return;
  for (const auto& [name, c] :
       {std::pair{"up", std::size_t{0}}, std::pair{"down", std::size_t{1}}}) {
    const std::string at = std::string("/true/cylinder/") + name;
    out.scalar(at + "/pressure", "Pa", "absolute",
               [c = c](const Snapshot& m) { return m.true_of->robot.cylinder_pressure[c]; });
    out.scalar(at + "/air_in", "kg", "from the supply since the start",
               [c = c](const Snapshot& m) { return m.true_of->robot.cylinder_in[c]; });
    out.scalar(at + "/air_out", "kg", "to the atmosphere since the start",
               [c = c](const Snapshot& m) { return m.true_of->robot.cylinder_out[c]; });
  }
}

}  // namespace

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

}  // namespace sinew::run
