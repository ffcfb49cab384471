// actuator/hysteresis.h - rate-independent friction of the mesh: the pressure has to change by a
// certain amount before the mesh moves or reverses.
//
//   F = F(L, P_e)       P_e = P_g - P_f                     fill: P_f = w, vent: P_f = -w
//   P_f = P_x - z       z the play that follows P_x = P_g + P_V V/V_max, |P_x - z| <= w
//   w = w_0 + w_P P_g + w_eps (1 - L/L_max) + w_F F/F_P     half the loop's width at one length
//
//   P_g, P_e  gauge pressure, effective pressure of the mesh [Pa]     w_0, w_eps, P_V [Pa]
//   P_f       friction, as a pressure [Pa]                            w_P, w_F [-], below 1
//   z         the only state [Pa]       L, L_max  length, with straight threads [m]
//   V, V_max  volume of the braid, its maximum (braid.h) [m3]
//   F/F_P     tension over its slope by the pressure: pressure that pulls [Pa]; at most twice the
//             part of P_g above the threshold of the effectiveness
//
// With w_F alone filling and venting pull 1 - w_F and 1 + w_F of F, where F is linear in P_g.
//
// With P_V = 0 only the pressure reverses the friction: a cycle of pressure at constant length has
// a loop, a cycle of length at constant pressure has none. With P_V a change of volume reverses it
// too, by P_V/V_max per volume: the friction then opposes the motion, whatever the pressure does.
// The friction dissipates the work P_f dV. Over a closed loop of length at constant pressure that
// work is never negative, and is 2 w for every volume if P_V is large; for loops of both this holds
// to within w V_max/P_V times the change of pressure. With P_V = 0 a muscle that is stretched at
// high pressure and released at low pressure returns that much energy: set P_V where muscles brake.
//
// Not in the thesis, which draws the loops (figure 2-8) and models those of length by dry friction
// ([33], loss.h). Valid for any pressure; bounded by w. Where w grows by less than 1 per pascal,
// P_e grows with the pressure, and the play does not depend on the path: any steps through the same
// turning points lead to the same z. This is so for w_F = 0, and for w_P + 2 w_F < 1 where the
// slope F_P does not fall with the pressure.
#pragma once

#include <algorithm>

#include "sinew/actuator/actuator.h"
#include "sinew/actuator/braid.h"
#include "sinew/actuator/stiffness.h"
#include "sinew/actuator/tension.h"
#include "sinew/units/constants.h"

namespace sinew::actuator {

// Returns whether there is friction that depends on the pressure's direction.
constexpr bool has_hysteresis(const Hysteresis& h) {
  return h.half_width > 0 || h.width_per_pressure > 0 || h.width_per_contraction > 0 ||
         h.width_per_tension > 0;
}

// Returns w_P + 2 w_F, the largest growth of w per gauge pressure.
constexpr double width_growth(const Hysteresis& h) {
  return h.width_per_pressure + 2 * h.width_per_tension;
}

// Growth from which w may take all of a rising pressure: that of a muscle is less.
inline constexpr double most_width_growth = 1;

// Returns the bound of F/F_P at a gauge pressure [Pa]. It is 0 at the threshold, below which the
// pressure does not pull, so that F/F_P has no jump there.
inline double most_pulling_pressure(const Actuator& a, double gauge_pressure) {
  return 2 * std::max(gauge_pressure - a.effectiveness.threshold, 0.0);
}

// Returns F/F_P, the part of the gauge pressure that pulls [Pa]; 0 where the muscle does not pull
// or its threshold takes the pressure.
inline double pulling_pressure(const Actuator& a, double length, double gauge_pressure,
                               double atmosphere) {
  const double force = clamped_tension(a, length, 0, gauge_pressure, atmosphere);
  const double slope =
      tension_per_pressure(a, length, gauge_pressure, atmosphere, EffectivenessSlope::included);
  if (!(force > 0 && slope > 0 && gauge_pressure > 0)) return 0;
  return std::min(force / slope, most_pulling_pressure(a, gauge_pressure));
}

// Returns w, the bound of the friction [Pa]; below the atmosphere that at the atmosphere.
inline double half_width(const Actuator& a, double length, double gauge_pressure,
                         double atmosphere = units::atmosphere) {
  const Hysteresis& h = a.hysteresis;
  const double contraction = 1.0 - length / a.long_end.length;
  const double w = h.half_width +
                   h.width_per_pressure * (gauge_pressure > 0 ? gauge_pressure : 0.0) +
                   (contraction > 0 ? h.width_per_contraction * contraction : 0.0);
  if (!(h.width_per_tension > 0)) return w;
  return w + h.width_per_tension * pulling_pressure(a, length, gauge_pressure, atmosphere);
}

// Returns P_x, which the play follows [Pa].
inline double drive(const Hysteresis& h, const Braid& braid, double length, double gauge_pressure) {
  if (!(h.volume_pressure > 0)) return gauge_pressure;
  const double greatest = volume(braid, shortest_length(braid));
  return gauge_pressure + h.volume_pressure * volume(braid, length) / greatest;
}

// Returns the play z of half-width w: it is constant while P_x is within w and dragged along beyond
// [Pa].
constexpr double play(double z, double x, double w) {
  return z < x - w ? x - w : z > x + w ? x + w : z;
}

// Effective pressure of the mesh at this length and pressure, and its play.
struct EffectivePressure {
  double gauge_pressure = 0;  // [Pa]
  double play = 0;            // z [Pa]
};
inline EffectivePressure effective_pressure(const Actuator& a, double length, double gauge_pressure,
                                            double z, double atmosphere = units::atmosphere) {
  const double x = drive(a.hysteresis, a.braid, length, gauge_pressure);
  const double now = play(z, x, half_width(a, length, gauge_pressure, atmosphere));
  return {gauge_pressure - (x - now), now};
}

// Returns z without friction, where the effective pressure is the gauge pressure.
inline double play_at_rest(const Actuator& a, double length, double gauge_pressure) {
  return drive(a.hysteresis, a.braid, length, gauge_pressure);
}

}  // namespace sinew::actuator
