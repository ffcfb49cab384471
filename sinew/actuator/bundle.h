// actuator/bundle.h - equal actuators in parallel that share their air, 4.2 (two per muscle).
//
//   tension, stiffness = count x one actuator's        volume = count x one actuator's + external
//
// A sealed bundle equals `count` single actuators with external/count each.
#pragma once

#include "sinew/actuator/actuator.h"
#include "sinew/actuator/braid.h"
#include "sinew/actuator/stiffness.h"
#include "sinew/actuator/tension.h"

namespace sinew::actuator {

struct Bundle {
  Actuator actuator;           // each of them
  int count = 1;               // in parallel
  double external_volume = 0;  // hoses and fittings of the bundle, downstream of the valves [m^3]
};

// Returns the volume of the air [m^3].
inline double volume(const Bundle& bundle, double length) {
  return bundle.count * volume(bundle.actuator, length) + bundle.external_volume;
}

// Returns the static and viscous tension with both ends clamped [N].
inline double clamped_tension(const Bundle& bundle, double length, double velocity,
                              double gauge_pressure, double atmosphere) {
  return bundle.count *
         clamped_tension(bundle.actuator, length, velocity, gauge_pressure, atmosphere);
}

// Returns the stiffness of the braids while valves hold the pressure [N/m].
inline double stiffness_at_constant_pressure(const Bundle& bundle, double length,
                                             double gauge_pressure, double atmosphere) {
  return bundle.count *
         stiffness_at_constant_pressure(bundle.actuator, length, gauge_pressure, atmosphere);
}

// Returns the stiffness of the braids with shut valves; `pressure` is absolute [N/m].
inline double stiffness_sealed(const Bundle& bundle, double length, double pressure,
                               double atmosphere, double polytropic_exponent) {
  return bundle.count * stiffness_sealed(bundle.actuator, length, pressure, atmosphere,
                                         bundle.external_volume / bundle.count,
                                         polytropic_exponent);
}

}  // namespace sinew::actuator
