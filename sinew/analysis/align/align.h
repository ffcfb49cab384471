// analysis/align/align.h - two recordings of one motion, aligned in time.
//
//   Alignment found = align(a, b, {.by = AlignBy::correlation, .fit_clock = true});
//   reclock(b, found.clock);              b's times are those of a's clock now
//
// They are laid by an event or by the greatest correlation (correlation.h), or by a shift known
// already; then, where it is wished, the clock's rate too. By default the
// channels are those of the first kind that moves in both recordings: angles, lengths, positions,
// tensions, pressures, all others, counts. What only a simulation knows (/true), plans (/desired)
// and valves are not asked: a measurement has none, or they would say nothing of the motion.
//
// Recordings of the same samples give exactly 0.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "sinew/analysis/align/correlation.h"
#include "sinew/signals/table.h"
#include "sinew/units/constants.h"

namespace sinew::analysis {

// Shift and rate of a clock from the shifts of pieces of a recording.
//
// The recording is cut into pieces; of each, the shift is found at which it is most alike
// (correlation.h), starting from that of the piece beside it, so that a slow clock is followed
// through any number of periods of a walk.
//
//   t_sk = t_s + rho·t_k       t_sk shift of piece k, t_k its middle, by least squares with weights
//                              1/se_k^2, se_k of correlation.h (a hundredth of a sample's step at
//                              least), times Huber's min(1, 1.345·scale/|e_k|); e_k =
//                              residual/se_k, scale 1.4826·median |e_k|
//   cov = q (X'WX)^-1          q = max(1, sum w·e^2/(n - 2)): its square roots are the standard
//                              uncertainties of t_s and rho
//   known rate                 the same with t_s alone, n - 1

// One piece, and by how much the other clock is ahead in it.
struct LocalShift {
  double time = 0, shift = 0;  // [s]
  double uncertainty = 0;      // standard one of the shift [s]
};

// The shifts of pieces about a clock that is right near the time `known_at` at least [s], where the
// search begins; the peak over the shift is `half_width` wide. What moves too little, or is not
// alike (r < 0.6), is left out.
std::vector<LocalShift> local_shifts(std::span<const Pair> pairs, const Clock& about,
                                     double known_at, double half_width);

// A clock, and how sure it is.
struct ClockFit {
  Clock clock = {};
  double shift_uncertainty = 0, rate_uncertainty = 0;  // standard ones  [s], [-]
  std::size_t pieces = 0;
};

inline constexpr std::size_t least_pieces = 4;  // of which a rate is believed

// There are `least_pieces` shifts or more.
ClockFit fit_clock(std::span<const LocalShift> shifts);
// The shift alone, of a clock with that rate. There are two shifts or more.
ClockFit fit_shift(std::span<const LocalShift> shifts, double rate);

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
