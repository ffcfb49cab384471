#include "sinew/run/setup/planar_setup.h"

#include "sinew/robot/actuator_of.h"
#include "sinew/run/setup/air_faults.h"
#include "sinew/run/setup/stand_setup.h"

namespace sinew::run {

using experiment::Experiment;
using experiment::find_valve;

namespace {

// Returns the robot's cylinder with its valves, if it is driven by air.
std::optional<air::Cylinder> cylinder_of(const Experiment& e) {
  using Mode = robot::Cylinder::Mode;
  const robot::Cylinder& c = e.robot.cylinder;
  if (!c.present || c.mode == Mode::locked || c.mode == Mode::free) return {};
  air::Cylinder out{.bore = c.bore,
                    .rod_diameter = c.rod_diameter,
                    .stroke = c.stroke,
                    .dead_volume = {c.up.dead_volume, c.down.dead_volume},
                    .pressure = c.pressure,
                    .initial_pressure = {e.start.pressure, e.start.pressure}};
  if (c.mode == Mode::regulator) {
    out.mode = air::Cylinder::Mode::regulator;
    return out;
  }
  for (const air::Side side : {air::up, air::down}) {
    const robot::Cylinder::Chamber& chamber = side == air::up ? c.up : c.down;
    if (const gas::Valve* v = find_valve(e, chamber.inlet)) out.inlet[side] = *v;
    if (const gas::Valve* v = find_valve(e, chamber.exhaust)) out.exhaust[side] = *v;
  }
  return out;
}

}  // namespace

std::vector<air::Muscle> muscles_of(const Experiment& e) {
  std::vector<air::Muscle> muscles;
  for (const robot::Muscle& m : e.robot.muscles) {
    air::Muscle out{.name = m.name, .count = m.count, .external_volume = m.external_volume};
    out.actuator = robot::actuator_of(m, e.actuators);
    if (const gas::Valve* v = find_valve(e, m.inlet)) out.inlet = *v;
    if (const gas::Valve* v = find_valve(e, m.exhaust)) out.exhaust = *v;
    out.hose = m.hose;
    out.leak = m.leak;
    muscles.push_back(std::move(out));
  }
  return muscles;
}

plant::Setup planar_setup(const Experiment& e) {
  plant::Setup s{.robot = e.robot, .muscles = muscles_of(e), .air = e.air, .supply = e.supply};
  for (const robot::Joint& j : e.robot.joints) {
    s.start.joint_angle.push_back(e.start.joint_angles.at(j.name));
    bool blocked = false;
    for (const std::string& name : e.start.blocked) blocked = blocked || name == j.name;
    s.start.blocked.push_back(blocked);
  }
  s.cylinder = cylinder_of(e);
  s.faults = air_faults(e);
  s.start.trolley = e.start.trolley;
  s.start.lift = e.start.lift;
  s.start.pressure = e.start.pressure;
  s.steps.body = e.body_step;
  s.seed = static_cast<std::uint64_t>(e.seed);
  return s;
}

plant::AnySetup machine_setup(const Experiment& e) {
  if (e.stand) return stand_setup(e);
  return planar_setup(e);
}

}  // namespace sinew::run
