// identify/actuator/static_spread.h - how far a force that is measured lies from the predicted one.
//
//   sigma_F^2 = sigma^2 + g' Cov g + (g_L sigma_L)^2        half-width = q sigma_F
//
//   sigma  scatter of the points that were fitted [N]       g  dF/d(parameter) at the point
//   g_L    dF/d(rest length) of a muscle that was not fitted, sigma_L the deviation of its label
//          (static_labels.h); 0 for those that were
//   Cov    covariance of the parameters                     sigma_F  deviation by the fit [N]
//   q      quantile of |measured - predicted|/sigma_F over points that were not fitted  [-]
//
// sigma_F describes where a guess is safer and where less so, and grows outside the data; q says
// how large it is, from what went wrong when parts of the data were left out. There are three kinds
// of guess, each with a q of its own: between the ends of the data, beyond them, and of a muscle of
// another rest length. No law of errors is assumed: the quantiles are those of the points that were
// left out (split-conformal prediction; of muscles the worst one, as points of one muscle err
// together).
//
// Between two lengths the form of the law errs besides, at all pressures alike, by the more the
// further the nearest one is:
//
//   half-width^2 = (q sigma_F)^2 + (q_t kappa_d eps_d F_max)^2
//   kappa_d^2 = (nu_0 kappa_d0^2 + sum e_k^2/eps_dk^2) / (nu_0 + n_L)
//
//   eps_d  distance of the nearest measured length, as a share of the rest length; 0 beyond the
//      ends, as the ends that were left out have it in their q [-]
//   F_max  largest force [N]         q_t  Student's factor of nu_0 + n_L degrees of freedom
//   e_k^2  mean square of the error at the k-th of n_L lengths that were left out, less that at
//      pressures that were left out, in shares of F_max [-]; the sum is no less than 0
//      eps_dk  its eps_d
//   kappa_d0 = 0.08, nu_0 = 1  assumed for any law on any muscle beforehand; both were chosen so
//      that intervals hold on seven muscles (docs/theory/static-models.md)
//
// kappa_d is the scale of a normal law of errors with a conjugate prior; few muscles have more than
// two lengths between their ends, and a quantile of two says nothing. Beyond the longest length
// nothing is told where no mount is within 1 % of the rest length: the bladder's first pull is
// steepest there, and no shorter one shows it (of five muscles 100 of 201 forces lay in 95 %).
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

  // Half-widths between lengths: t c F, for each a  [N].
  double between_68 = 0, between_95 = 0;

  // What the worst of the muscles that were left out was missed by, in shares of its own largest
  // force, and |ln| of the greatest ratio to the rest length that was next to it  [-]. 0: none was.
  double other_share_68 = 0, other_share_95 = 0, other_reach = 0;
};

// A length that was left out: e_k^2 and a_k above  [-].
struct MissedLength {
  double square = 0, away = 0;
};

// Writes the half-widths between lengths of a law whose lengths were missed by this; the largest
// force is F  [N].
void add_between(std::span<const MissedLength> missed, double largest_force, StaticSpread& spread);

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
