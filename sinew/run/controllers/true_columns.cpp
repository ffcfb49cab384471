// run/controllers/true_columns.cpp - columns that only a simulation can provide.
#include <algorithm>
#include <cmath>
#include <type_traits>

#include "sinew/experiment/faults.h"
#include "sinew/run/controllers/column_list.h"

namespace sinew::run {
namespace {

using T = plant::Truth;

// Adds a column of a true value of the robot, or of an element of one of its arrays.
void truth(Columns& out, std::string name, std::string unit, std::string description,
           double T::*value) {
  out.scalar(std::move(name), std::move(unit), std::move(description),
             [value](const Snapshot& m) { return m.true_of->robot.*value; });
  out.list.back().is_of_motion = value == &T::x || value == &T::x_rate;
}
template <class Array>
void truth(Columns& out, std::string name, std::string unit, std::string description,
           Array T::*values, std::size_t i) {
  out.scalar(std::move(name), std::move(unit), std::move(description),
             [values, i](const Snapshot& m) { return (m.true_of->robot.*values)[i]; });
  if constexpr (std::is_same_v<Array, decltype(T::angle)>)
    out.list.back().is_of_motion = values == &T::angle || values == &T::rate;
}

void true_joint_columns(const robot::Robot& robot, Columns& out) {
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const std::string at = "/true" + robot::topic_of_joint(robot, j);
    truth(out, at + "/angle", "rad", "of the simulated joint", &T::angle, j);
    truth(out, at + "/velocity", "rad/s", "of the simulated joint", &T::rate, j);
    truth(out, at + "/torque", "N m", "of its muscles", &T::torque, j);
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
    truth(out, at + "/tension", "N", "in the tendon", &T::tension, i);
    truth(out, at + "/pressure", "Pa", "absolute", &T::pressure, i);
    truth(out, at + "/length", "m", "of the actuators", &T::length, i);
    truth(out, at + "/mass", "kg", "of the air in the bundle", &T::mass, i);
    truth(out, at + "/air_in", "kg", "from the supply since the start", &T::air_in, i);
    truth(out, at + "/air_out", "kg", "to the atmosphere since the start", &T::air_out, i);
    if (leaks(e, robot.muscles[i]))
      truth(out, at + "/air_leaked", "kg", "to the atmosphere, past the valves, since the start",
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
  truth(out, "/true/air/mass", "kg", "in chambers, hoses and tank", &T::air_mass);
  const bool fails = std::ranges::any_of(e.faults, [](const experiment::Fault& f) {
    return f.what == experiment::Fault::What::failed;
  });
  if (fails && e.supply.kind == gas::Supply::Kind::tank)
    truth(out, "/true/supply/air_past_tank", "kg",
          "from the line while a fault had cut it from its tank, since the start",
          &T::air_past_tank);
}

void true_supply_columns(const gas::Supply& supply, Columns& out) {
  if (supply.kind != gas::Supply::Kind::tank) return;
  truth(out, "/true/supply/pressure", "Pa", "of the line to the inlets, absolute",
        &T::supply_pressure);
  truth(out, "/true/supply/tank_pressure", "Pa", "before the regulator, absolute",
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
    truth(out, leg.topic("/true/foot/" + point.name + "/load"), "N", "of the ground, up",
          &T::disc_force, disc++);
  if (foot.points.empty()) ++disc;
}

void true_body_columns(const robot::Robot& robot, Columns& out) {
  if (robot.trolley.present) {
    truth(out, "/true/trolley/position", "m", "along the track", &T::x);
    truth(out, "/true/trolley/velocity", "m/s", "along the track", &T::x_rate);
  }
  std::size_t disc = 0;
  for (const LegAt& leg : legs_at(robot)) true_foot_columns(robot, leg, disc, out);
  if (!robot.rollers.present) return;
  truth(out, "/true/roller/front/load", "N", "below 0: it has lifted off", &T::roller_front);
  truth(out, "/true/roller/rear/load", "N", "below 0: it has lifted off", &T::roller_rear);
}

void true_cylinder_columns(const robot::Robot& robot, Columns& out) {
  if (!moves(robot.cylinder)) return;
  truth(out, "/true/cylinder/position", "m", "up from the extended stop", &T::lift);
  truth(out, "/true/cylinder/velocity", "m/s", "upwards", &T::lift_rate);
  if (robot.cylinder.mode == robot::Cylinder::Mode::free) return;
  for (const auto& [name, c] :
       {std::pair{"up", std::size_t{0}}, std::pair{"down", std::size_t{1}}}) {
    const std::string at = std::string("/true/cylinder/") + name;
    truth(out, at + "/pressure", "Pa", "absolute", &T::cylinder_pressure, c);
    truth(out, at + "/air_in", "kg", "from the supply since the start", &T::cylinder_in, c);
    truth(out, at + "/air_out", "kg", "to the atmosphere since the start", &T::cylinder_out, c);
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
