// Chapter 3's setups as structs, for tests.
#pragma once

#include "sinew/actuator/thesis_actuator.h"
#include "sinew/mechanism/slide/setup.h"
#include "sinew/units/constants.h"

namespace sinew::plant {

using units::inch;
using units::psi;

// Returns the stand with trapped air, figures 3-6 to 3-11: sealed at rest under the load, released
// 0.2 in below.
inline StandSetup trapped(double gauge_psi, double load_pounds) {
  StandSetup s;
  s.muscle.actuator = actuator::thesis_actuator();
  s.muscle.external_volume = 0.114 * inch * inch * inch;
  s.load.mass = load_pounds * units::pound_mass;
  s.start = {.pressure = s.air.atmosphere + gauge_psi * psi, .displacement = 0.2 * inch};
  return s;
}

// Returns the stand with a pulsed 3-way valve, figures 3-14 to 3-23: from the slack muscle at 3.4
// in.
inline StandSetup pulsed(double load_pounds) {
  StandSetup s = trapped(0, load_pounds);
  s.muscle.external_volume = 0.495 * inch * inch * inch;
  s.muscle.inlet.kind = gas::Valve::Kind::three_way;
  s.muscle.inlet.profile = gas::Valve::Profile::ideal;
  s.muscle.inlet.flow = {.area = 1.8e-5 * units::foot * units::foot, .efficiency = 0.85};
  s.charge.mode = Charge::Mode::valves;
  s.start = {.pressure = s.air.atmosphere, .length = 3.4 * inch};
  return s;
}

}  // namespace sinew::plant
