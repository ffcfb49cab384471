// actuator/toe.h - the soft beginning of the pull: a slack muscle is bent, and straightens before
// it pulls with all that it has.
//
//   T = s ln(1 + exp(B/s))       dT/dB = 1/(1 + exp(-B/s))
//
//   B  what braid and bladder pull with at one length and pressure [N], pull.h; below 0 the muscle
//      would push   T  what it pulls with [N]   s  tension of the toe [N], 0: T = B
//
// T is positive, grows with B, is s ln 2 at B = 0 and within s exp(-B/s) of B above it. A muscle
// with a toe never pushes; without one it does, as an actuator that is clamped and straight would.
// Named after the toe of a tendon's curve. Festo muscles of 10 mm that are mounted shorter than
// they are long have s of 14 to 27 N, the less the longer they are (docs/theory/static-models.md):
// as a beam that buckles. Not in the thesis. The air keeps the volume of a straight muscle.
#pragma once

#include "sinew/actuator/actuator.h"
#include "sinew/units/math.h"

namespace sinew::actuator {

// Says where B is so far from 0, in toes, that nothing of the toe is left in 53 bits  [-].
inline constexpr double toe_ends = 40;

// Returns T  [N]. Without a toe it is `pull` itself, to the bit.
constexpr double toe_tension(const Toe& toe, double pull) {
  const double s = toe.tension;
  if (!(s > 0) || pull > toe_ends * s) return pull;
  if (pull > 0) return pull + s * units::log(1.0 + units::exp(-pull / s));
  const double x = pull > -600 * s ? pull / s : -600;
  const double e = units::exp(x);
  // ln(1 + e) of an e that 1 would swallow.
  return s * (x > -18 ? units::log(1.0 + e) : e);
}

// Returns dT/dB, 0 to 1  [-]. Without a toe it is 1.
constexpr double toe_share(const Toe& toe, double pull) {
  const double s = toe.tension;
  if (!(s > 0) || pull > toe_ends * s) return 1.0;
  if (pull > 0) return 1.0 / (1.0 + units::exp(-pull / s));
  const double e = units::exp(pull > -600 * s ? pull / s : -600);
  return e / (1.0 + e);
}

}  // namespace sinew::actuator
