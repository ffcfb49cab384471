// actuator/braid.h - geometry of the braid, [1]-[21] and [41].
//
//   L = b cos(theta), D = b sin(theta)/(n pi)                    [1], [2]
//   V = L (b^2 - L^2) / (4 pi n^2)                               [21]
//
// Valid for 0 < L < b: thin walls, threads that do not stretch, no end cones.
#pragma once

#include <cmath>
#include <numbers>

#include "sinew/actuator/actuator.h"

namespace sinew::actuator {

// Returns 1 / (4 pi n^2), a common factor of all laws of the braid [-].
constexpr double braid_factor(const Braid& braid) {
  return 1.0 / (4.0 * std::numbers::pi * braid.turns * braid.turns);
}

// Returns a braid from its opened mesh, [17], [18]: N_A trapezoids lengthwise, N_B around, with a
// given side [m].
constexpr Braid braid_from_trapezoids(double lengthwise, double around, double side) {
  return {.thread_length = 2.0 * lengthwise * side, .turns = lengthwise / around};
}

// Returns the length of largest volume and zero tension: theta = 54.7 deg, [5], [6] [m].
inline double shortest_length(const Braid& braid) { return braid.thread_length / std::sqrt(3.0); }

// Returns the angle between thread and axis, [19] [rad]; NaN beyond the thread's length.
inline double braid_angle(const Braid& braid, double length) {
  return std::acos(length / braid.thread_length);
}

// Returns the diameter, [2], [20] [m].
inline double diameter(const Braid& braid, double length) {
  const double b = braid.thread_length;
  return std::sqrt(b * b - length * length) / (braid.turns * std::numbers::pi);
}

// Returns the volume, [21]; zero from the thread's length on, as in appendix A [m^3].
constexpr double volume(const Braid& braid, double length) {
  const double b2 = braid.thread_length * braid.thread_length;
  const double inside = length * (b2 - length * length) * braid_factor(braid);
  return length < braid.thread_length ? inside : 0.0;
}

// Returns dV/dL, [41] without the velocity; zero where the volume is (not in appendix A) [m^2].
constexpr double volume_slope(const Braid& braid, double length) {
  const double b2 = braid.thread_length * braid.thread_length;
  const double inside = (b2 - 3.0 * length * length) * braid_factor(braid);
  return length < braid.thread_length ? inside : 0.0;
}

}  // namespace sinew::actuator
