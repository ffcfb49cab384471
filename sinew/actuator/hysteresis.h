// actuator/hysteresis.h - friction that does not ask how fast: more pressure must be let in before
// the mesh moves, and let out before it moves back.
//
//   F = F(L, P_e)       P_e = P_g - P_f                     fill: P_f = w, vent: P_f = -w
//   P_f = P_x - z       z the play that follows P_x = P_g + P_V V/V_max, |P_x - z| <= w
//   w = w_0 + w_P P_g + w_eps (1 - L/L_max), >= 0           half the loop's width at one length
//
//   P_g, P_e  gauge pressure, effective pressure of the mesh [Pa]     w_0, w_eps, P_V [Pa]
//   P_f       friction, as a pressure [Pa]                            w_P [-], below 1
//   z         the only state [Pa]       L, L_max  length, that of straight threads [m]
//   V, V_max  volume of the braid, its greatest (braid.h) [m3]
//
// With P_V = 0 only the pressure turns the friction: a loop of pressure at one length, none of
// length at one pressure. With P_V a change of volume turns it as well, by P_V/V_max per volume:
// friction then opposes the motion, whatever the pressure does. It takes the work P_f dV. Over a
// closed loop of length at one pressure that is never negative, and 2 w for every volume if P_V is
// large; loops of both at once keep to it within w V_max/P_V times the change of pressure. With
// P_V = 0 a muscle that is stretched at high pressure and released at low pressure gives that much
// back: state P_V where muscles brake.
//
// Not in the thesis, which draws the loops (figure 2-8) and models those of length by dry friction
// ([33], loss.h). Valid for any pressure; bounded by w; P_e grows with the pressure. The play
// forgets how it was reached: any steps through the same turning points lead to the same z.
#pragma once

#include "sinew/actuator/actuator.h"
#include "sinew/actuator/braid.h"

namespace sinew::actuator {

// Is there any friction that the pressure turns?
constexpr bool has_hysteresis(const Hysteresis& h) {
  return h.half_width > 0 || h.width_per_pressure > 0 || h.width_per_contraction > 0;
}

// w, the bound of the friction  [Pa]. Below the atmosphere that of the atmosphere.
constexpr double half_width(const Actuator& a, double length, double gauge_pressure) {
  const Hysteresis& h = a.hysteresis;
  const double contraction = 1.0 - length / a.long_end.length;
  return h.half_width + h.width_per_pressure * (gauge_pressure > 0 ? gauge_pressure : 0.0) +
         (contraction > 0 ? h.width_per_contraction * contraction : 0.0);
}

// P_x, which the play follows  [Pa].
inline double drive(const Hysteresis& h, const Braid& braid, double length, double gauge_pressure) {
  if (!(h.volume_pressure > 0)) return gauge_pressure;
  const double greatest = volume(braid, shortest_length(braid));
  return gauge_pressure + h.volume_pressure * volume(braid, length) / greatest;
}

// Play of half-width w: z stays while P_x moves within it and is dragged along beyond  [Pa].
constexpr double play(double z, double x, double w) {
  return z < x - w ? x - w : z > x + w ? x + w : z;
}

// What the mesh feels at this length and pressure, and the play that goes with it.
struct Felt {
  double gauge_pressure = 0;  // [Pa]
  double play = 0;            // z [Pa]
};
inline Felt felt(const Actuator& a, double length, double gauge_pressure, double z) {
  const double x = drive(a.hysteresis, a.braid, length, gauge_pressure);
  const double now = play(z, x, half_width(a, length, gauge_pressure));
  return {gauge_pressure - (x - now), now};
}

// z of a muscle that feels what it has: no friction.
inline double play_at_rest(const Actuator& a, double length, double gauge_pressure) {
  return drive(a.hysteresis, a.braid, length, gauge_pressure);
}

}  // namespace sinew::actuator
