// identify/actuator/static_spread.h - how far a force that is measured lies from the predicted one.
//
//   w^2 = s^2 + g' Cov g + (h sigma)^2  half-width = q w
//
//   s  scatter of the points that were fitted [N]       g  dF/d(parameter) at the point
//   h  dF/d(rest length) of a muscle that was not fitted, sigma what its label may be off
//      (static_labels.h); 0 for those that were
//   Cov  covariance of the parameters                   w  what the fit itself expects [N]
//   q  quantile of |measured - predicted|/w over points that a fit had not seen  [-]
//
// w says where a guess is safer and where less so, and grows outside the data; q says how large it
// is, from what went wrong when parts of the data were left out. There are three kinds of guess,
// each with a q of its own: between the ends of the data, beyond them, and of a muscle of another
// rest length. No law of errors is assumed: the quantiles are those of the points that were left
// out (split-conformal prediction; of muscles the worst one, as points of one muscle err together).
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "sinew/identify/actuator/static_data.h"
#include "sinew/identify/actuator/static_fit.h"

namespace sinew::identify {

// Quantiles of one kind of guess. Infinite where nothing of the kind was left out.
struct Quantiles {
  double q68 = std::numeric_limits<double>::infinity();
  double q95 = std::numeric_limits<double>::infinity();
  std::size_t points = 0;  // that were left out
};

// Which kind of guess a prediction is.
enum class Guess { inside, beyond, other_muscle };

// All three kinds, of one law on some data.
struct StaticSpread {
  Quantiles inside, beyond, other_muscle;

  // What the worst of the muscles that were left out was missed by, in shares of its own largest
  // force, and |ln| of the greatest ratio to the rest length that was next to it  [-]. 0: none was.
  double other_share_68 = 0, other_share_95 = 0, other_reach = 0;

  // Returns those of a kind.
  const Quantiles& of(Guess guess) const;
};

// Points that a fit had not seen: what it missed them by, and what it expected to.
struct Unseen {
  std::vector<double> residuals, widths;  // predicted - measured; w  [N]

  // Adds the points of the other to its own.
  void add(const Unseen& other);
};

// Returns what a fit makes of points that it had not seen. A slack point, measured and predicted,
// has no width (NaN): that it was guessed right says nothing of points that pull.
Unseen unseen_by(const StaticFit& fit, const StaticScales& scales,
                 std::span<const StaticPoint> points);

// Returns w of each point  [N]. Directions that the data do not determine do not count: q does.
std::vector<double> widths(const StaticFit& fit, const StaticScales& scales,
                           std::span<const StaticPoint> points);

// Returns the quantiles of |residual|/w, of points that have a width. Fewer than 20 points have
// none of their own: Student's factor times the root mean square stands for them.
Quantiles quantiles(const Unseen& unseen);

// Returns the larger of both in each place.
Quantiles wider(const Quantiles& a, const Quantiles& b);

}  // namespace sinew::identify
