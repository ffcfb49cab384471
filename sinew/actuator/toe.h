// actuator/toe.h - the soft beginning of the pull: a slack muscle is bent, and straightens before
// it pulls with all that it has.
//
//   F_t = F_toe ln(1 + exp(B/F_toe))       dF_t/dB = 1/(1 + exp(-B/F_toe))
//
//   B  what braid and bladder pull with at one length and pressure [N], pull.h; below 0 the muscle
//      would push   F_t  what it pulls with [N]   F_toe  tension of the toe [N], 0: F_t = B
//
// F_t is positive, grows with B, is F_toe ln 2 at B = 0, within F_toe exp(-B/F_toe) of B above it.
// A muscle with a toe never pushes; without one it does, as an actuator that is clamped and
// straight would. Named after the toe of a tendon's curve. Festo muscles of 10 mm that are mounted
// shorter than they are long have F_toe of 14 to 27 N, the less the longer they are
// (docs/theory/static-models.md): as a beam that buckles. Not in the thesis. The air keeps the
// volume of a straight muscle.
#pragma once

#include "sinew/actuator/actuator.h"
#include "sinew/units/math.h"

namespace sinew::actuator {

// Says where B is so far from 0, in toes, that nothing of the toe is left in 53 bits  [-].
inline constexpr double toe_ends = 40;

// F_t [N] and dF_t/dB [-].
struct ToePull {
  double tension = 0, share = 1;
};

// Returns both, with one exponential. Without a toe F_t is `pull` itself, to the bit, and the
// share 1.
constexpr ToePull toe_pull(const Toe& toe, double pull) {
  const double s = toe.tension;
  if (!(s > 0) || pull > toe_ends * s) return {pull, 1.0};
  if (pull > 0) {
    const double e = units::exp(-pull / s);
    return {pull + s * units::log(1.0 + e), 1.0 / (1.0 + e)};
  }
  const double x = pull > -600 * s ? pull / s : -600;
  const double e = units::exp(x);
  // ln(1 + e) of an e that 1 would swallow.
  return {s * (x > -18 ? units::log(1.0 + e) : e), e / (1.0 + e)};
}

// Returns F_t alone  [N].
constexpr double toe_tension(const Toe& toe, double pull) { return toe_pull(toe, pull).tension; }

// Returns dF_t/dB alone, 0 to 1  [-].
constexpr double toe_share(const Toe& toe, double pull) { return toe_pull(toe, pull).share; }

}  // namespace sinew::actuator
