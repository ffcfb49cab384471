#include "sinew/run/setup/stand_setup.h"

#include <stdexcept>

#include "sinew/experiment/faults.h"
#include "sinew/run/setup/air_faults.h"
#include "sinew/world/stand.h"

namespace sinew::run {
namespace {

using experiment::Experiment;
using experiment::find_valve;
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

plant::StandSetup stand_setup(const Experiment& e) {
  plant::StandSetup s = unbroken(e);
  const auto tear = [&](int) { return tear_area(s.muscle.actuator, length_at_start(s)); };
  s.faults =
      air_faults(e.faults, {.parts = fault_parts(e), .atmosphere = e.air.atmosphere, .tear = tear});
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
