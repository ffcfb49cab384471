#include "sinew/run/setup/machine_setup.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>

#include "sinew/actuator/braid.h"
#include "sinew/experiment/faults.h"
#include "sinew/robot/actuator_of.h"
#include "sinew/world/stand.h"

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

// --- faults of the air ---

using What = experiment::Fault::What;

double or_none(double x) { return std::isfinite(x) ? x : 0.0; }

// Returns the assumed area of a tear that the braid holds together: a tenth of the cross-section of
// one actuator at that length [m^2].
double tear_area(const actuator::Actuator& a, double length) {
  const double d = actuator::diameter(a.braid, length - a.caps.length);
  return 0.1 * (0.25 * std::numbers::pi * d * d);
}

air::AirFault air_fault(const experiment::Fault& f, const experiment::FaultPart& part,
                        double atmosphere, const std::function<double(int)>& tear) {
  using To = air::AirFault::What;
  air::AirFault out{.of = part.index,
                    .begin = f.at,
                    .end = end_of(f),
                    .share = f.share,
                    .leak = {.area = or_none(f.area), .conductance = f.conductance}};
  if (f.what == What::stuck_shut) out.what = To::stuck_shut;
  if (f.what == What::leaking)
    out.what = part.kind == experiment::FaultPart::Kind::valve ? To::seat_leak : To::hole;
  if (f.what == What::blocked) out.what = To::blocked;
  if (f.what == What::failed) {
    out.what = To::supply;
    out.pressure = std::isfinite(f.pressure) ? f.pressure : atmosphere;
  }
  if (f.what == What::ruptured) {
    out.what = To::hole;
    if (!(f.area > 0)) out.leak.area = tear(part.index);
  }
  return out;
}

// Returns the faults of the air, in their order; `tear` is the area of a muscle's tear, by its
// index [m^2].
std::vector<air::AirFault> air_faults(const Experiment& e, const std::function<double(int)>& tear) {
  const std::vector<experiment::FaultPart> parts = fault_parts(e);
  std::vector<air::AirFault> out;
  for (const experiment::Fault& f : e.faults)
    if (const auto part = part_of(f, parts); part && !is_of_sensor(f.what))
      out.push_back(air_fault(f, *part, e.air.atmosphere, tear));
  return out;
}

// --- the test stand ---

using experiment::Stand;
using signals::steps_of;

signals::Schedule schedule(double constant, const std::vector<signals::Schedule::Point>& points) {
  return points.empty() ? signals::Schedule(constant) : signals::Schedule(points);
}

air::Cylinder cylinder_of(const Stand::Element::Cylinder& c, const gas::Valve* in,
                          const gas::Valve* out) {
  air::Cylinder cylinder{.mode = air::Cylinder::Mode::single_acting,
                         .bore = c.bore,
                         .rod_diameter = c.rod_diameter,
                         .stroke = c.stroke,
                         .dead_volume = {c.dead_volume, 0}};
  if (in) cylinder.inlet[air::up] = *in;
  if (out) cylinder.exhaust[air::up] = *out;
  return cylinder;
}

plant::StandSetup unbroken(const Experiment& e) {
  const Stand& stand = *e.stand;
  plant::StandSetup s{.air = e.air, .supply = e.supply};
  const gas::Valve* inlet = find_valve(e, stand.element.inlet);
  const gas::Valve* exhaust = find_valve(e, stand.element.exhaust);
  if (stand.element.cylinder.bore > 0) {
    s.cylinder = cylinder_of(stand.element.cylinder, inlet, exhaust);
  } else {
    s.muscle = {.name = stand.element.name,
                .count = stand.element.count,
                .external_volume = stand.element.external_volume,
                .hose = stand.element.hose,
                .leak = stand.element.leak};
    for (const actuator::Actuator& a : e.actuators)
      if (a.name == stand.element.actuator) s.muscle.actuator = a;
    if (inlet) s.muscle.inlet = *inlet;
    if (exhaust) s.muscle.exhaust = *exhaust;
  }
  s.load.mode = stand.load.mode;
  if (stand.load.mode == robot::Stand::Load::Mode::hanging) {
    s.load.mass = schedule(stand.load.mass, steps_of(stand.load.weights));
    s.load.force = schedule(stand.load.force, stand.load.forces);
    s.load.gravity = stand.load.gravity;
  } else {
    s.load.length = schedule(stand.load.length, stand.load.lengths);
  }
  s.charge.mode = stand.charge.mode;
  if (stand.charge.mode == robot::Stand::Charge::Mode::regulated)
    s.charge.pressure = schedule(stand.charge.pressure, stand.charge.pressures);
  s.start = {.pressure = stand.start_pressure > 0 ? stand.start_pressure : e.air.atmosphere,
             .length = stand.start_length,
             .displacement = stand.displacement};
  s.transducers = stand.sensors;
  s.step = stand.step;
  s.accuracy = stand.accuracy;
  s.seed = static_cast<std::uint64_t>(e.seed);
  return s;
}

double length_at_start(const plant::StandSetup& s) {
  if (s.load.mode == robot::Stand::Load::Mode::driven) return s.load.length.at(0);
  return s.start.length > 0 ? s.start.length : plant::hanging_length(s);
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

std::vector<air::AirFault> air_faults(const Experiment& e) {
  return air_faults(e, [&](int muscle) {
    const robot::Muscle& m = e.robot.muscles[static_cast<std::size_t>(muscle)];
    return tear_area(robot::actuator_of(m, e.actuators), m.mount_length);
  });
}

plant::Setup planar_setup(const Experiment& e) {
  plant::Setup s{.robot = e.robot, .muscles = muscles_of(e), .air = e.air, .supply = e.supply};
  for (const robot::Joint& j : e.robot.joints) {
    s.start.joint_angle.push_back(e.start.joint_angles.at(j.name));
    s.start.blocked.push_back(std::ranges::count(e.start.blocked, j.name) > 0);
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

void check_air_faults(std::span<const experiment::Fault> faults,
                      std::vector<robot::Contradiction>& out) {
  constexpr std::size_t most = air::FaultSchedule::capacity;
  const auto of_air = static_cast<std::size_t>(std::ranges::count_if(
      faults, [](const experiment::Fault& f) { return !is_of_sensor(f.what); }));
  if (of_air > most)
    out.push_back({"fault", std::to_string(of_air) + " faults of the air",
                   "at most " + std::to_string(most), "fewer"});
}

plant::StandSetup stand_setup(const Experiment& e) {
  plant::StandSetup s = unbroken(e);
  s.faults = air_faults(e, [&](int) { return tear_area(s.muscle.actuator, length_at_start(s)); });
  return s;
}

void check_stand_setup(const Experiment& e, std::vector<robot::Contradiction>& wrong) {
  try {
    const plant::Stand stand(unbroken(e));
  } catch (const std::invalid_argument& refused) {
    wrong.push_back({"load", refused.what(), "a set-up that can be built", ""});
  }
}

}  // namespace sinew::run
