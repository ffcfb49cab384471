// actuator/body.h - parts of a real tube other than its braid: rigid ends within its length, a
// taper towards them, a wall. With them the braid works at another length and holds less air.
//
//   L_b = L - d                        Tondu (2012): caps and clamps, of L d does not contract [m]
//   L_b = L_0 - kappa (L_0 - L)        Tondu and Lopez (2000): tapering ends as a contraction that
//                                      is kappa times as large
//   kappa = kappa_0 + kappa_low exp(-P_g/P_low)          smaller as pressure fills the ends:
//                                                        Kerscher et al. (2006)
//   V = V_braid(L_b) - pi h_w L_b (D - h_w) + V_a
//                                      h_w  thickness of the wall [m], the air is within it
//                                      D  of the braid at L_b [m]
//                                      V_a  air added to that of the braid, at every length [m3]
//   A_t = pi h_w (D_0 (2 sin(theta) - 1/sin(theta)) - h_w)
//                                      tension per pressure of the wall [m2], the virtual work of
//                                      V: Chou and Hannaford (1996)
//   D_0 = b/(n pi), sin(theta) = D/D_0
//
// No volume belongs to kappa, which is not geometric: V is that of the braid at L - d. Without
// these parameters all results equal those of braid.h to the bit.
#pragma once

#include <cmath>
#include <numbers>

#include "sinew/actuator/actuator.h"
#include "sinew/actuator/braid.h"
#include "sinew/units/math.h"

namespace sinew::actuator {

// Returns kappa [-].
constexpr double taper_gain(const Taper& taper, double gauge_pressure) {
  if (!(taper.extra_gain != 0)) return taper.gain;
  const double x = gauge_pressure > 0 ? -gauge_pressure / taper.extra_pressure : 0.0;
  return taper.gain + taper.extra_gain * units::exp(x > -700 ? x : -700);
}

// Returns whether the tube narrows at its ends; otherwise the taper has no effect.
constexpr bool tapers(const Taper& taper) { return taper.gain != 1 || taper.extra_gain != 0; }

// Returns L_b, the length at which the braid works [m]. With a taper it is limited to 0, far below
// the range in which the braid pulls.
constexpr double working_length(const Actuator& a, double length, double gauge_pressure) {
  const double braid = length - a.caps.length;
  if (!tapers(a.taper)) return braid;
  const double rest = a.taper.rest_length - a.caps.length;
  const double x = rest - taper_gain(a.taper, gauge_pressure) * (rest - braid);
  return x > 0 ? x : 0.0;
}

// Returns the length at which the braid is at its shortest, b/sqrt 3; with a taper, at high
// pressure [m].
inline double shortest_length(const Actuator& a) {
  const double braid = shortest_length(a.braid);
  if (!tapers(a.taper)) return braid + a.caps.length;
  const double rest = a.taper.rest_length - a.caps.length;
  return rest - (rest - braid) / a.taper.gain + a.caps.length;
}

// Returns D_0, the diameter with threads across the axis [m].
constexpr double widest_diameter(const Braid& braid) {
  return braid.thread_length / (braid.turns * std::numbers::pi);
}

// Returns sin(theta) at L_b, at least 0.1, since a wall has no room near zero [-].
inline double braid_sine(const Braid& braid, double x) {
  const double cosine = x / braid.thread_length;
  const double square = 1.0 - cosine * cosine;
  return square > 0.01 ? std::sqrt(square) : 0.1;
}

// Returns A_t [m2].
inline double wall_area(const Actuator& a, double x) {
  const double t = a.wall.thickness;
  if (!(t > 0)) return 0.0;
  const double s = braid_sine(a.braid, x);
  return std::numbers::pi * t * (widest_diameter(a.braid) * (2.0 * s - 1.0 / s) - t);
}

// Returns dA_t/dL_b [m].
inline double wall_area_slope(const Actuator& a, double x) {
  const double t = a.wall.thickness, b = a.braid.thread_length;
  if (!(t > 0)) return 0.0;
  const double s = braid_sine(a.braid, x);
  if (!(s > 0.1)) return 0.0;
  return -std::numbers::pi * t * widest_diameter(a.braid) * (2.0 + 1.0 / (s * s)) * x / (b * b * s);
}

// Returns the volume of the air in one actuator  [m3], never below 0.
inline double volume(const Actuator& a, double length) {
  const double x = length - a.caps.length, t = a.wall.thickness;
  double braid = t > 0 ? 0.0 : volume(a.braid, x);
  if (t > 0) {
    const double inside = widest_diameter(a.braid) * braid_sine(a.braid, x) - 2.0 * t;
    if (inside > 0) braid = 0.25 * std::numbers::pi * x * inside * inside;
  }
  if (a.air.offset == 0) return braid;
  const double sum = braid + a.air.offset;
  return sum > 0 ? sum : 0.0;
}

// Returns dV/dL [m2].
inline double volume_slope(const Actuator& a, double length) {
  const double x = length - a.caps.length;
  if (a.air.offset < 0 && !(volume(a, length) > 0)) return 0.0;
  return volume_slope(a.braid, x) - wall_area(a, x);
}

}  // namespace sinew::actuator
