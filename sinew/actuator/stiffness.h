// actuator/stiffness.h - slope of the tension over length, [23]-[27], with valves open or sealed.
//
//   k_P = dF/dL at constant pressure = 6 P_g L Eff/(4 pi n^2)                          [26]
//   k_m = dF/dL at constant air mass = k_P + dF/dP_g dP/dL                             [24]
//         dP/dL = -n_p P V'/(V + V_ext)      because P (V + V_ext)^n_p is constant     [40]
//   k_F = [26] with the pressure computed from the tension = 6 F L/(3 L^2 - b^2)       [27]
//
//   L, b, n  braid.h     P, P_g  absolute, gauge pressure [Pa]     n_p  polytropic exponent [-]
//   V, V'    volume of one actuator [m3] and its slope [m2]         V_ext  hoses, per actuator [m3]
//
// The thesis sets dP/dL = 0 in [25], which gives k_P. A muscle with shut valves has k_m, which is
// 1.23 to 1.85 times k_P at 60 psi gauge between 3.15 and 3.4 in (V_ext 0.495 and 0.114 in3, n_p =
// 1.4).
//
// The functions are for the braid and its body (body.h) of one actuator, within 0 < L < b. Ends and
// bladder: passive_stiffness. n actuators in parallel: bundle.h. Eff is not in the thesis's [26],
// but in its [31], whose derivative is needed here.
#pragma once

#include "sinew/actuator/actuator.h"
#include "sinew/actuator/braid.h"
#include "sinew/actuator/tension.h"

namespace sinew::actuator {

// Names whether Eff changes with the pressure while the length changes, as in [30], or is constant.
enum class EffectivenessSlope { included, neglected };

// Returns [26] of the effective tension [31], the braid's part of the muscle's stiffness [N/m].
inline double stiffness_at_constant_pressure(const Actuator& a, double length,
                                             double gauge_pressure, double atmosphere) {
  const double x = braid_length(a, length, gauge_pressure, atmosphere);
  return braid_pull_slope(a, x, gauge_pressure, atmosphere) *
         share_of_stiffness(a, x, gauge_pressure, atmosphere);
}

// Returns [27], the same stiffness computed from the tension without the pressure [N/m].
//
// It has a pole at the shortest length b/sqrt 3, where 0/0 replaces a finite k, and below it a
// positive tension gives a negative k. The effectiveness cancels. Tension of ends, bladder and
// friction does not cancel and dominates near the pole, so the function must not be used there.
constexpr double stiffness_from_tension(const Braid& braid, double length, double tension) {
  const double b2 = braid.thread_length * braid.thread_length;
  return 6.0 * tension * length / (3.0 * length * length - b2);
}

// Returns dEff/dP: zero outside the fitted pressures, where Eff is constant [1/Pa].
constexpr double effectiveness_slope(const Effectiveness& e, double gauge_pressure,
                                     double atmosphere) {
  if (gauge_pressure < e.valid_from || gauge_pressure > e.valid_to) return 0.0;
  const bool absolute = e.argument == Effectiveness::Argument::absolute;
  const double p = absolute ? gauge_pressure + atmosphere : gauge_pressure;
  return e.scale * (e.c1 + 2.0 * e.c2 * p);
}

// Returns dF/dP of the braid's tension at constant length [m2]; zero up to the threshold.
inline double tension_per_pressure(const Actuator& a, double length, double gauge_pressure,
                                   double atmosphere, EffectivenessSlope slope) {
  const double braid = braid_length(a, length, gauge_pressure, atmosphere);
  const double x = working_length(a, braid, gauge_pressure);
  const double acting = acting_pressure(a.effectiveness, gauge_pressure);
  const double eff = effectiveness(a.effectiveness, gauge_pressure, atmosphere);
  const double eff_slope = slope == EffectivenessSlope::included
                               ? effectiveness_slope(a.effectiveness, gauge_pressure, atmosphere)
                               : 0.0;

  // F = P_act g(x) Eff(P_g), so dF/dP_g = g (Eff + P_act Eff'); with a taper g changes with the
  // pressure, too. Elastic ends reduce it by the same share as a stiffness.
  const double g = ideal_tension(a.braid, x, 1.0) + wall_area(a, x);
  const double idle = gauge_pressure > 0 && acting == 0 ? 0.0 : 1.0;
  const double left = share_of_stiffness(a, braid, gauge_pressure, atmosphere);
  const double held_length = g * (idle * eff + acting * eff_slope);
  if (!(a.taper.extra_gain != 0) || gauge_pressure < 0) return left * held_length;
  const double gain_slope =
      -(taper_gain(a.taper, gauge_pressure) - a.taper.gain) / a.taper.extra_pressure;
  const double g_slope = ideal_stiffness(a.braid, x, 1.0) + wall_area_slope(a, x);
  const double moved = acting * eff * g_slope * gain_slope * (braid - a.taper.rest_length);
  return left * (held_length + moved);
}

// Returns dP/dL of sealed air, [40] with m' = 0 [Pa/m], from the volume and its slope for one
// actuator [m3] [m2].
constexpr double pressure_slope_sealed(double volume, double volume_slope, double pressure,
                                       double external_volume, double polytropic_exponent) {
  return -polytropic_exponent * pressure * volume_slope / (volume + external_volume);
}

// Returns the same for a braid without a body.
constexpr double pressure_slope_sealed(const Braid& braid, double length, double pressure,
                                       double external_volume, double polytropic_exponent) {
  return pressure_slope_sealed(volume(braid, length), volume_slope(braid, length), pressure,
                               external_volume, polytropic_exponent);
}

// Returns dF/dL at constant air mass, [24] with its first term [N/m]. `external_volume` is one
// actuator's share: that of the bundle divided by its number of actuators.
inline double stiffness_sealed(const Actuator& a, double length, double pressure, double atmosphere,
                               double external_volume, double polytropic_exponent,
                               EffectivenessSlope slope = EffectivenessSlope::included) {
  const double gauge_pressure = pressure - atmosphere;
  return stiffness_at_constant_pressure(a, length, gauge_pressure, atmosphere) +
         tension_per_pressure(a, length, gauge_pressure, atmosphere, slope) *
             pressure_slope_sealed(volume(a, length), volume_slope(a, length), pressure,
                                   external_volume, polytropic_exponent);
}

// Returns dF/dL of the parts without air: stretched threads, end stop, bladder [N/m]. Together with
// one of the functions above it is the slope of tension(), except below the short end with
// ShortEnd::Law::zero. The pressure matters only with elastic ends or a toe.
inline double passive_stiffness(const Actuator& a, double length, double gauge_pressure,
                                double atmosphere) {
  const double x = braid_length(a, length, gauge_pressure, atmosphere);
  double k = bladder_stiffness(a.bladder, x) * share_of_stiffness(a, x, gauge_pressure, atmosphere);
  if (length > a.long_end.length) k += a.long_end.stiffness;
  if (length < shortest_length(a) && a.short_end.law == ShortEnd::Law::stop) {
    k += a.short_end.stiffness;
  }
  return k;
}

}  // namespace sinew::actuator
