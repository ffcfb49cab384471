// analysis/align/align.h - two recordings of one motion, aligned in time.
//
//   Alignment found = align(a, b, {.by = AlignBy::correlation, .fit_clock = true});
//   reclock(b, found.clock);              b's times are those of a's clock now
//
// They are laid by an event (event.h), by the greatest correlation (correlation.h), or by a shift
// known already; then, where it is wished, the clock's rate too (clock_fit.h). Without a wish the
// channels are those of the first kind that moves in both recordings: angles, lengths, positions,
// tensions, pressures, all others, counts. What only a simulation knows (/true), plans (/desired)
// and valves are not asked: a measurement has none, or they would say nothing of the motion.
//
// Recordings of the same samples give exactly 0.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "sinew/analysis/align/clock_fit.h"
#include "sinew/signals/table.h"
#include "sinew/units/constants.h"

namespace sinew::analysis {

// How shifts are found; `known`: it is given.
enum class AlignBy { known, event, correlation };

// Constraint on the alignment of recordings.
struct AlignRequest {
  std::string name = {};  // of the other recording, for errors
  AlignBy by = AlignBy::correlation;
  double shift = 0, known_at = 0;  // a known one, and where it is right [s]
  std::string event = {};          // "/joint/elbow/angle > 10 deg"; empty: the surest first motion
  std::vector<std::string> channels = {};                       // to be correlated; empty: chosen
  bool fit_clock = false;                                       // its rate too
  double most_shift = std::numeric_limits<double>::infinity();  // that is looked for [s]
  double atmosphere = units::atmosphere;                        // [Pa]
};

// Alignment of the other recording with the first one.
struct Alignment {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  Clock clock = {};
  double shift_uncertainty = unknown, rate_uncertainty = unknown;  // standard ones [s], [-]
  double correlation = unknown;            // that is reached; mean of `channels`
  std::vector<std::string> channels = {};  // that were correlated
  std::string event = {};                  // in words; empty: none was asked for
  std::size_t pieces = 0;                  // whose shifts were fitted
  bool same = false;                       // those channels hold the same samples
  // Where the rate was not fitted, yet shows itself beyond three times its uncertainty [-].
  double rate_seen = 0, rate_seen_uncertainty = 0;
};

// Throws config::Error, saying why, where the recordings cannot be aligned so: no common
// channel moves, an event does not happen, a correlation stays below 0.6, hardly changes with the
// shift, or is as high at another one.
Alignment align(const signals::Table& first, const signals::Table& other,
                const AlignRequest& request);

// All times become those of the first one's clock, to a nanosecond.
void reclock(signals::Table& table, const Clock& clock);

}  // namespace sinew::analysis
