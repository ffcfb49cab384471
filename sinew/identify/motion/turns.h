// identify/motion/turns.h - where a noisy oscillation turns round, its period and where it comes to
// rest.
//
// A turn counts once the motion has come back from it by more than the noise explains. Its length
// is that of a polynomial of fourth order through the samples within a sixth of a period, so that
// noise averages out and a peak is not taken for its highest noise. Samples that stand alone do not
// count. A record may begin with the mass held, or at the very instant of its release.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace sinew::identify {

struct Turn {
  double time = 0;     // [s]
  double value = 0;    // of the oscillating quantity, in its unit
  bool upper = false;  // a maximum
};

struct Oscillation {
  std::vector<Turn> turns;  // alternately upper and lower, five at least
  double period = 0;        // median over the first turns [s]
  double noise = 0;         // standard deviation of one sample
  double rest = 0;          // where it comes to rest; NaN: the record ends before
  std::size_t falls = 0;    // sample at which it is well on its way from the first turn
  std::vector<bool> spike;  // per sample: stands alone, and does not count
};

// `subject` begins messages. Throws Refusal for what does not swing twice to and fro, is clipped,
// or has fewer than 20 samples per period. `time` ascends.
Oscillation find_turns(std::span<const double> time, std::span<const double> value,
                       const std::string& subject);

}  // namespace sinew::identify
