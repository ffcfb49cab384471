// actuator/hysteresis.h - friction that does not ask how fast: more pressure must be let in before
// the mesh moves, and let out before it moves back.
//
//   F = F(L, P_felt)    P_felt = P_g - s                         fill: s = w, vent: s = -w
//   s = x - z           z the play that follows x = P_g + K V/V_max, |x - z| <= w
//   w = a + b P_g + d (1 - L/L_max), >= 0    half the width of the loop at one length
//
//   P_g  gauge pressure [Pa]   L, L_max  length, that of straight threads [m]   V, V_max  volume of
//   the braid, its greatest (braid.h) [m3] a, d, K [Pa]   b [-], below 1   s  friction, as a
//   pressure [Pa]   z  the only state [Pa]
//
// With K = 0 only the pressure turns the friction: a loop of pressure at one length, none of length
// at one pressure. With K a change of volume turns it as well, by K/V_max per volume: friction then
// opposes the motion, whatever the pressure does. What it takes is s dV. Over a closed loop of
// length at one pressure that is never negative, and 2 w for every volume if K is large; loops of
// both at once keep to it within w V_max/K times the way that the pressure goes. With K = 0 a
// muscle that is stretched at high pressure and let go at low gives that much back: state K where
// muscles brake.
//
// Not in the thesis, which draws the loops (figure 2-8) and models those of length by dry friction
// ([33], loss.h). Valid for any pressure; bounded by w; P_felt grows with the pressure. The play
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

// x, what the play follows  [Pa].
inline double drive(const Hysteresis& h, const Braid& braid, double length, double gauge_pressure) {
  if (!(h.volume_pressure > 0)) return gauge_pressure;
  const double greatest = volume(braid, shortest_length(braid));
  return gauge_pressure + h.volume_pressure * volume(braid, length) / greatest;
}

// Play of half-width w: z stays while x moves within it and is dragged along beyond  [Pa].
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
