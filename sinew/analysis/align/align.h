// analysis/align/align.h - two recordings of one motion, aligned in time.
//
//   Alignment found = align(a, b, {.by = AlignBy::correlation, .fit_clock = true});
//   reclock(b, found.clock);              b's times are those of a's clock now
//
// They are aligned by an event, by the greatest correlation (correlation.h) or by a given shift,
// and on request by the clock's rate too. By default the channels are those of the first kind that
// moves in both recordings: angles, lengths, positions, tensions, pressures, all others, counts.
// True values of a simulation (/true), plans (/desired) and valves are left out: a measurement
// lacks them, or they do not describe the motion.
//
// Recordings with the same samples give a shift of exactly 0.
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
// The recording is cut into pieces. The shift of each one with the greatest correlation
// (correlation.h) is searched from the shift of its neighbour, so that a drifting clock is followed
// through any number of periods of a walk.
//
//   t_sk = t_s + rho·t_k       t_sk shift of piece k, t_k its middle, by least squares with weights
//                              1/se_k^2, se_k of correlation.h (a hundredth of a sample's step at
//                              least), times Huber's min(1, 1.345·scale/|e_k|); e_k =
//                              residual/se_k, scale 1.4826·median |e_k|
//   cov = q (X'WX)^-1          q = max(1, sum w·e^2/(n - 2)): its square roots are the standard
//                              uncertainties of t_s and rho
//   known rate                 the same with t_s alone, n - 1

// Shift of one piece: the lead of the other clock.
struct LocalShift {
  double time = 0, shift = 0;  // middle of the piece, shift [s]
  double uncertainty = 0;      // standard uncertainty of the shift [s]
};

// Returns the shifts of the pieces. The clock `about` has to be right near the time `known_at` [s],
// at which the search begins; `half_width` is that of the peak of r over the shift [s]. Pieces that
// move too little, or with r < 0.6, are left out.
std::vector<LocalShift> local_shifts(std::span<const Pair> pairs, const Clock& about,
                                     double known_at, double half_width);

// A clock with its uncertainties.
struct ClockFit {
  Clock clock = {};
  double shift_uncertainty = 0, rate_uncertainty = 0;  // standard uncertainties  [s], [-]
  std::size_t pieces = 0;
};

inline constexpr std::size_t least_pieces = 4;  // smallest number of pieces that determine a rate

// Fits shift and rate. Requires `least_pieces` shifts or more.
ClockFit fit_clock(std::span<const LocalShift> shifts);
// Fits the shift of a clock with the given rate. Requires two shifts or more.
ClockFit fit_shift(std::span<const LocalShift> shifts, double rate);

// Method by which the shift is found; `known`: it is given.
enum class AlignBy { known, event, correlation };

// Options of an alignment.
struct AlignRequest {
  std::string name = {};  // name of the other recording, for errors
  AlignBy by = AlignBy::correlation;
  double shift = 0, known_at = 0;  // given shift, and the time at which it is right [s]
  std::string event = {};  // "/joint/elbow/angle > 10 deg"; empty: the most certain first motion
  std::vector<std::string> channels = {};  // to be correlated; empty: chosen
  bool fit_clock = false;                  // fit the clock's rate too
  double largest_shift =
      std::numeric_limits<double>::infinity();  // largest shift of the search [s]
  double atmosphere = units::atmosphere;        // [Pa]
};

// Alignment of the other recording with the first one.
struct Alignment {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  Clock clock = {};
  // Standard uncertainties [s], [-].
  double shift_uncertainty = unknown, rate_uncertainty = unknown;
  double correlation = unknown;            // r of the result, mean of `channels`
  std::vector<std::string> channels = {};  // channels that were correlated
  std::string event = {};                  // description; empty if not aligned by an event
  std::size_t pieces = 0;                  // number of pieces whose shifts were fitted
  bool same = false;                       // `channels` have the same samples in both
  // A rate beyond three times its uncertainty that was found but not fitted [-]; else 0.
  double rate_seen = 0, rate_seen_uncertainty = 0;
};

// Aligns two recordings. Throws config::Error with the reason if no common channel moves, an event
// does not happen, or the correlation stays below 0.6, hardly changes with the shift, or is as high
// at another shift.
Alignment align(const signals::Table& first, const signals::Table& other,
                const AlignRequest& request);

// Converts all times of `table` to the first recording's clock, rounded to a nanosecond.
void reclock(signals::Table& table, const Clock& clock);

}  // namespace sinew::analysis
