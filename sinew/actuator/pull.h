// actuator/pull.h - tension of braid and bladder at the braid's own length, and its slope.
//
//   B = P_act Eff(p) (b^2/(4 pi n^2) (3 L_b^2/b^2 - 1) + A_t(L_b)) + bladder(L_s)
//
//   L_s  length of the muscle without the stretch of its ends, series.h [m]
//   L_b  length at which the braid works, from L_s by body.h [m]      P_act, Eff  below
#pragma once

#include "sinew/actuator/actuator.h"
#include "sinew/actuator/bladder.h"
#include "sinew/actuator/body.h"
#include "sinew/actuator/braid.h"

namespace sinew::actuator {

// Returns Eff, [30] [-]. It is constant outside the fitted pressures, since a polynomial does not
// extrapolate.
constexpr double effectiveness(const Effectiveness& e, double gauge_pressure, double atmosphere) {
  const double low = gauge_pressure < e.valid_from ? e.valid_from : gauge_pressure;
  const double inside = low > e.valid_to ? e.valid_to : low;
  const double p = e.argument == Effectiveness::Argument::absolute ? inside + atmosphere : inside;
  return e.scale * (e.c0 + p * (e.c1 + p * e.c2));
}

// Returns P_act, the part of the gauge pressure that widens the mesh [Pa]: the bladder takes the
// threshold before it touches the mesh. Vacuum acts on the mesh without a threshold.
constexpr double acting_pressure(const Effectiveness& e, double gauge_pressure) {
  if (gauge_pressure > e.threshold) return gauge_pressure - e.threshold;
  return gauge_pressure < 0 ? gauge_pressure : 0.0;
}

// Returns the ideal tension, [22] [N].
constexpr double ideal_tension(const Braid& braid, double length, double gauge_pressure) {
  const double b2 = braid.thread_length * braid.thread_length;
  return gauge_pressure * (3.0 * length * length - b2) * braid_factor(braid);
}

// Returns [26] as printed, without Eff [N/m].
constexpr double ideal_stiffness(const Braid& braid, double length, double gauge_pressure) {
  return 6.0 * gauge_pressure * length * braid_factor(braid);
}

// Returns [22] times Eff for the braid and its body at L_s [N].
inline double braid_pull(const Actuator& a, double x, double gauge_pressure, double atmosphere) {
  const double acting = acting_pressure(a.effectiveness, gauge_pressure);
  const double w = working_length(a, x, gauge_pressure);
  return (ideal_tension(a.braid, w, acting) + acting * wall_area(a, w)) *
         effectiveness(a.effectiveness, gauge_pressure, atmosphere);
}

// Returns its slope, [26] of the effective tension [31], at constant pressure [N/m].
inline double braid_pull_slope(const Actuator& a, double x, double gauge_pressure,
                               double atmosphere) {
  const double acting = acting_pressure(a.effectiveness, gauge_pressure);
  const double w = working_length(a, x, gauge_pressure);
  return (ideal_stiffness(a.braid, w, acting) + acting * wall_area_slope(a, w)) *
         taper_gain(a.taper, gauge_pressure) *
         effectiveness(a.effectiveness, gauge_pressure, atmosphere);
}

}  // namespace sinew::actuator
