// analysis/align/clock_fit.h - shift and rate of a clock from the shifts of pieces of a recording.
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
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sinew/analysis/align/correlation.h"

namespace sinew::analysis {

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

}  // namespace sinew::analysis
