// actuator/pull.h - what braid and bladder pull with at the length that the braid has, and how that
// grows with the length.
//
//   B = P_act Eff(p) (b^2/(4 pi n^2) (3 L_b^2/b^2 - 1) + A_t(L_b)) + bladder(L_s)
//
//   L_s  length of the muscle without what its ends give way, series.h [m]
//   L_b  length at which the braid works, of L_s as body.h has it [m]      P_act, Eff  below
#pragma once

#include "sinew/actuator/actuator.h"
#include "sinew/actuator/bladder.h"
#include "sinew/actuator/body.h"
#include "sinew/actuator/braid.h"

namespace sinew::actuator {

// [30]  [-]. Constant outside the fitted range of pressures: a polynomial is no law there.
constexpr double effectiveness(const Effectiveness& e, double gauge_pressure, double atmosphere) {
  const double low = gauge_pressure < e.valid_from ? e.valid_from : gauge_pressure;
  const double inside = low > e.valid_to ? e.valid_to : low;
  const double p = e.argument == Effectiveness::Argument::absolute ? inside + atmosphere : inside;
  return e.scale * (e.c0 + p * (e.c1 + p * e.c2));
}

// P_act, what is left of the gauge pressure to widen the mesh: the bladder takes the threshold
// before it touches. Vacuum pulls the mesh in at once  [Pa].
constexpr double acting_pressure(const Effectiveness& e, double gauge_pressure) {
  if (gauge_pressure > e.threshold) return gauge_pressure - e.threshold;
  return gauge_pressure < 0 ? gauge_pressure : 0.0;
}

// [22]: the ideal tension  [N].
constexpr double ideal_tension(const Braid& braid, double length, double gauge_pressure) {
  const double b2 = braid.thread_length * braid.thread_length;
  return gauge_pressure * (3.0 * length * length - b2) * braid_factor(braid);
}

// [26] as printed, without Eff  [N/m].
constexpr double ideal_stiffness(const Braid& braid, double length, double gauge_pressure) {
  return 6.0 * gauge_pressure * length * braid_factor(braid);
}

// [22] times Eff, of the braid and its body at L_s  [N].
inline double braid_pull(const Actuator& a, double x, double gauge_pressure, double atmosphere) {
  const double acting = acting_pressure(a.effectiveness, gauge_pressure);
  const double w = working_length(a, x, gauge_pressure);
  return (ideal_tension(a.braid, w, acting) + acting * wall_area(a, w)) *
         effectiveness(a.effectiveness, gauge_pressure, atmosphere);
}

// Its slope, [26] of the effective tension [31], at a constant pressure  [N/m].
inline double braid_pull_slope(const Actuator& a, double x, double gauge_pressure,
                               double atmosphere) {
  const double acting = acting_pressure(a.effectiveness, gauge_pressure);
  const double w = working_length(a, x, gauge_pressure);
  return (ideal_stiffness(a.braid, w, acting) + acting * wall_area_slope(a, w)) *
         taper_gain(a.taper, gauge_pressure) *
         effectiveness(a.effectiveness, gauge_pressure, atmosphere);
}

}  // namespace sinew::actuator
