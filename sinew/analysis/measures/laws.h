// analysis/measures/laws.h - the small formulas of docs/reference/analysis.md.
#pragma once

#include <cmath>
#include <numbers>

#include "sinew/actuator/stiffness.h"

namespace sinew::analysis {

// What is faster than this shows as oscillation  [s]: 21 samples every 10 ms.
inline constexpr double oscillation_window = 0.21;

// By how much a joint's error must come back from where it turned  [rad]: twice the smallest
// amplitude that counts as an oscillation, 0.5 deg. A plot of 60 deg just shows it, and a converter
// of 0.08 deg per count with a count or two of noise does not reach it.
inline constexpr double turn_back = std::numbers::pi / 180;

// Below this the foot counts as sticking  [m/s].
inline constexpr double sticking = 2e-3;

// Points per phase on which steps are compared.
inline constexpr int points_per_phase = 100;

// From `a` to `b` the shorter way round  [rad].
inline double turn_between(double a, double b) {
  return std::remainder(b - a, 2.0 * std::numbers::pi);
}

// Of one actuator at constant pressure [26], with the effectiveness, and of what pulls without air
// [N/m]. A slack cord has none.
inline double true_stiffness(const actuator::Actuator& a, double length, double pressure,
                             double atmosphere, double tension) {
  if (tension <= 0) return 0;
  const double gauge = pressure - atmosphere;
  return actuator::stiffness_at_constant_pressure(a, length, gauge, atmosphere) +
         actuator::passive_stiffness(a, length, gauge, atmosphere);
}

// One muscle's part in its joint's stiffness: r^2 times that of its actuators in parallel, [60]
// [N m/rad].
constexpr double joint_stiffness(double moment_arm, int actuators, double stiffness) {
  return moment_arm * moment_arm * actuators * stiffness;
}

}  // namespace sinew::analysis
