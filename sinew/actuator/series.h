// actuator/series.h - elastic ends: a spring between the clamps and the braid.
//
//   F_t(L_s) = (L - L_s)/C_s      F = F_t(L_s)      dF/dL = F_t'/(1 + C_s F_t')
//
//   L, L_s  length of the muscle, and without the stretch of its ends [m]
//   F_t  pull of braid and bladder after the toe (below), pull.h [N]; F_t = B without a toe
//   C_s  compliance of both ends together [m/N], 0: rigid
//
// C_s is a property of a pair of ends and does not depend on the rest length: short muscles lose a
// larger share of their stiffness to it. Festo muscles of 10 mm have some 0.011 mm/N
// (docs/theory/static-models.md).
//
// Newton's iteration starts from L_s = L. F_t is convex and grows with L_s, so every step but the
// first comes from above the solution and none overshoots. The air has the volume of the whole
// length: C_s F is 2 to 4 % of the length, and some 5 % of the volume at the highest force. Not in
// the thesis.
#pragma once

#include "sinew/actuator/actuator.h"
#include "sinew/actuator/pull.h"
#include "sinew/units/math.h"

namespace sinew::actuator {

// The soft beginning of the tension: a slack muscle is bent and straightens before it pulls fully.
//
//   F_t = F_toe ln(1 + exp(B/F_toe))       dF_t/dB = 1/(1 + exp(-B/F_toe))
//
//   B  pull of braid and bladder at one length and pressure [N], pull.h; below 0: push
//   F_t  tension [N]   F_toe  tension of the toe [N], 0: F_t = B
//
// F_t is positive, grows with B, is F_toe ln 2 at B = 0 and within F_toe exp(-B/F_toe) of B above
// it. A muscle with a toe never pushes; without one it does, like a straight actuator with clamped
// ends. The name is that of the toe of a tendon's curve. Festo muscles of 10 mm that are mounted
// shorter than their length have an F_toe of 14 to 27 N that falls with their length
// (docs/theory/static-models.md), as for a beam that buckles. Not in the thesis. The air has the
// volume of a straight muscle.

// B|/F_toe beyond which the toe's effect is below 53-bit precision  [-].
inline constexpr double toe_ends = 40;

// F_t [N] and dF_t/dB [-].
struct ToePull {
  double tension = 0, share = 1;
};

// Returns both with one exponential. Without a toe F_t equals `pull` to the bit, and the share is
// 1.
constexpr ToePull toe_pull(const Toe& toe, double pull) {
  const double s = toe.tension;
  if (!(s > 0) || pull > toe_ends * s) return {pull, 1.0};
  if (pull > 0) {
    const double e = units::exp(-pull / s);
    return {pull + s * units::log(1.0 + e), 1.0 / (1.0 + e)};
  }
  const double x = pull > -600 * s ? pull / s : -600;
  const double e = units::exp(x);
  // For small e, ln(1 + e) is e: the sum would round to 1.
  return {s * (x > -18 ? units::log(1.0 + e) : e), e / (1.0 + e)};
}

// Returns F_t [N].
constexpr double toe_tension(const Toe& toe, double pull) { return toe_pull(toe, pull).tension; }

// Returns dF_t/dB, 0 to 1 [-].
constexpr double toe_share(const Toe& toe, double pull) { return toe_pull(toe, pull).share; }

// Returns L_s [m]. With C_s = 0 it equals `length` to the bit.
inline double braid_length(const Actuator& a, double length, double gauge_pressure,
                           double atmosphere) {
  const double c = a.series.compliance;
  if (!(c > 0)) return length;
  const double acting = acting_pressure(a.effectiveness, gauge_pressure);
  const double eff = effectiveness(a.effectiveness, gauge_pressure, atmosphere);
  const double gain = taper_gain(a.taper, gauge_pressure);
  double x = length;
  for (int i = 0; i < 30; ++i) {
    const double w = working_length(a, x, gauge_pressure);
    const BladderPull bladder = bladder_pull(a.bladder, x);
    const double hard =
        (ideal_tension(a.braid, w, acting) + acting * wall_area(a, w)) * eff + bladder.tension;
    const ToePull toe = toe_pull(a.toe, hard);
    const double slope =
        ((ideal_stiffness(a.braid, w, acting) + acting * wall_area_slope(a, w)) * gain * eff +
         bladder.stiffness) *
        toe.share;
    const double grows = c * slope > -0.5 ? c * slope : -0.5;
    const double step = (c * toe.tension - (length - x)) / (1.0 + grows);
    x -= step;
    // The remaining error is of the order of the square of the last step: 1e-12 of the length.
    if (step < 1e-7 * length && step > -1e-7 * length) break;
  }
  return x;
}

// Returns the share of a stiffness of braid and bladder that remains at the muscle's ends, t/(1 +
// C_s t B') with t = dF_t/dB of the toe [-].
inline double share_of_stiffness(const Actuator& a, double x, double gauge_pressure,
                                 double atmosphere) {
  const double c = a.series.compliance;
  if (!(c > 0) && !(a.toe.tension > 0)) return 1.0;
  const BladderPull bladder = bladder_pull(a.bladder, x);
  const double share =
      toe_share(a.toe, braid_pull(a, x, gauge_pressure, atmosphere) + bladder.tension);
  if (!(c > 0)) return share;
  const double slope = braid_pull_slope(a, x, gauge_pressure, atmosphere) + bladder.stiffness;
  return share / (1.0 + c * share * slope);
}

}  // namespace sinew::actuator
