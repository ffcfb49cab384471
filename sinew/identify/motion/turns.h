// identify/motion/turns.h - turning points of a noisy oscillation, its period and its rest.
//
// A turn counts once the motion has come back from it by more than the noise. Its value is that of
// a fourth-order polynomial through the samples within a sixth of a period, which averages the
// noise and does not mistake its highest value for the peak. Isolated samples (spikes) do not
// count. A record may begin with the mass held, or at the instant of its release.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace sinew::identify {

struct Turn {
  double time = 0;     // [s]
  double value = 0;    // in the unit of the oscillating quantity
  bool upper = false;  // a maximum
};

struct Oscillation {
  std::vector<Turn> turns;  // alternately upper and lower, at least five
  double period = 0;        // median over the first turns [s]
  double noise = 0;         // standard deviation of one sample
  double rest = 0;          // value at rest; NaN: the record ends before
  std::size_t falls = 0;    // sample well on the way from the first turn
  std::vector<bool> spike;  // for each sample: isolated, does not count
};

// Finds the turns. `subject` begins messages; `time` ascends. Throws Refusal for a signal with less
// than two oscillations, with clipping, or with fewer than 20 samples per period.
Oscillation find_turns(std::span<const double> time, std::span<const double> value,
                       const std::string& subject);

}  // namespace sinew::identify
