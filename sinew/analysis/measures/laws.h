// analysis/measures/laws.h - the small formulas of docs/reference/analysis.md.
#pragma once

#include <cmath>
#include <numbers>

#include "sinew/actuator/stiffness.h"

namespace sinew::analysis {

// Window of the mean that is subtracted to show oscillation  [s]: 21 samples every 10 ms.
inline constexpr double oscillation_window = 0.21;

// Least return of a joint's error after a turning point  [rad]: twice the smallest amplitude that
// counts as an oscillation, 0.5 deg. It is just visible in a plot of 60 deg, and noise of one or
// two counts of a converter of 0.08 deg per count does not reach it.
inline constexpr double least_return = std::numbers::pi / 180;

// Smallest ranges that count as a cycle: a contraction [-] beyond the noise of an angle sensor, and
// a pressure range [Pa] beyond the noise of a transducer and the last pulses of a valve.
inline constexpr double least_contraction = 0.01, least_pressure = 1e4;

// Slip velocity below which the foot counts as sticking  [m/s].
inline constexpr double sticking = 2e-3;

// Points per phase at which steps are compared.
inline constexpr int points_per_phase = 100;

// Returns the turn from `a` to `b` the shorter way round  [rad].
inline double turn_between(double a, double b) {
  return std::remainder(b - a, 2.0 * std::numbers::pi);
}

// Returns the stiffness of one actuator at constant pressure, by [26] with the effectiveness, plus
// its passive stiffness  [N/m]; 0 if the tendon is slack.
inline double true_stiffness(const actuator::Actuator& a, double length, double pressure,
                             double atmosphere, double tension) {
  if (tension <= 0) return 0;
  const double gauge = pressure - atmosphere;
  return actuator::stiffness_at_constant_pressure(a, length, gauge, atmosphere) +
         actuator::passive_stiffness(a, length, gauge, atmosphere);
}

// Returns a muscle's contribution to its joint's stiffness: r^2 times the stiffness of its
// actuators in parallel, [60]  [N m/rad].
constexpr double joint_stiffness(double moment_arm, int actuators, double stiffness) {
  return moment_arm * moment_arm * actuators * stiffness;
}

}  // namespace sinew::analysis
