// identify/actuator/static_spread.h - distribution of measured forces about the predicted one.
//
//   sigma_F^2 = sigma^2 + v + g' Cov g + (g_L sigma_L)^2    half-width = q sigma_F
//
//   v      mean variance of the forces within averages; 0 for single readings [N2]
//   sigma  scatter of the points that were fitted [N]       g  dF/d(parameter) at the point
//   g_L    dF/d(rest length) of a muscle that was not fitted, sigma_L the deviation of its label
//          (static_labels.h); 0 for those that were
//   Cov    covariance of the parameters                     sigma_F  deviation by the fit [N]
//   q      quantile of |measured - predicted|/sigma_F over points that were not fitted  [-]
//
// sigma_F describes how the error varies with the point, and grows outside the data; q scales it
// to the errors found when parts of the data were left out: between the ends of the data, or beyond
// them. No distribution of errors is assumed: the quantiles are those of the points that were left
// out (split-conformal prediction), of which a single one must not decide: the half-width for 95 %
// is at most 2.5 times the root mean square.
//
// Errors of one muscle are correlated, and few muscles are left out, so muscles of other rest
// lengths have no quantile. Their errors grow with the force:
//
//   half-width = q rho sqrt(F_max^2 + (2 F)^2)      q = 1 for 68 %, 2.1 for 95 %
//   rho^2 = mean of (measured - predicted)^2/(F_max^2 + (2 F)^2) of each muscle left out, averaged
//
//   F  predicted force [N]   F_max  largest force of that muscle [N]
//
// Between two lengths the form of the law has an additional error, common to all pressures. It
// varies over the length like a random walk that is 0 at both lengths (a Brownian bridge):
//
//   half-width^2 = (q sigma_F)^2 + (q_d kappa_d F_max)^2 eps_d      q_d = 1 for 68 %, 2.35 for 95 %
//   kappa_d^2 = (1 - w) kappa_d0^2 + w mean(e_k^2/eps_dk)           w = n_L^4/(n_L^4 + 3)
//
//   eps_d  2 a b/(a + b) as a share of the rest length; a and b are the distances of the measured
//      lengths on either side [-]
//   sigma_F  interpolated between these two lengths by its square. That of the point itself is
//      larger by D, and kappa_d F_max sqrt(eps_d) is taken as sqrt(D)/3 at least
//   F_max  largest force [N]
//   e_k^2  mean square of the error at the k-th of n_L lengths that were left out, less that at
//      pressures that were left out, in shares of F_max [-]; the mean is no less than 0
//      eps_dk  its eps_d
//   kappa_d0 = 0.1  assumed for any law on any muscle beforehand. One length that was left out has
//      little weight, because the law was chosen by it; two outweigh the assumption. kappa_d0, w
//      and q_d were chosen so that both intervals hold on seven muscles, with one length or two
//      neighbours left out (docs/theory/static-models.md)
//
// Beyond the shortest length eps_d is 2 a, and three tenths of this half-width are added as a
// square: most of the error there is in the q of the ends that were left out.
//
// Few muscles have more than two lengths between their ends, and two values give no quantile.
// Beyond the longest length no interval is given: the bladder's first pull is steepest there, and
// shorter lengths do not show it (for five muscles only 100 of 201 forces were within the 95 %
// interval).
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "sinew/identify/actuator/static_data.h"
#include "sinew/identify/actuator/static_fit.h"

namespace sinew::identify {

// Quantiles of one kind of prediction; infinite if no point of this kind was left out.
struct Quantiles {
  double q68 = std::numeric_limits<double>::infinity();
  double q95 = std::numeric_limits<double>::infinity();
  std::size_t points = 0;  // number of points that were left out
};

// Kind of a prediction.
enum class PredictionKind { inside, beyond, other_muscle };

// Errors of all three kinds, for one law on some data.
struct StaticSpread {
  Quantiles inside, beyond;

  // Half-width of 68 % between lengths, per root of eps_d: kappa_d F_max [N].
  double between_68 = 0;

  // q rho of the muscles that were left out, and the greatest |ln| of the ratio to the nearest
  // other rest length [-]. 0: no muscle was left out.
  double other_share_68 = 0, other_share_95 = 0, other_reach = 0;
};

// A length that was left out: e_k^2 and eps_dk above [-].
struct LengthError {
  double square = 0, away = 0;
};

// Weight of the force in the error of a muscle of another rest length, and the half-widths that
// contain 68 and 95 % in multiples of the root mean square  [-].
inline constexpr double by_force = 2, other_68 = 1, other_95 = 2.1;

// q_d of 95 %, for errors between lengths  [-].
inline constexpr double form_95 = 2.35;

// Returns the errors of the readings behind averages with these errors: within an average they are
// distributed normally with its variance. Errors of single readings are unchanged.
std::vector<double> errors_of_readings(std::span<const double> errors,
                                       std::span<const double> variances);

// Writes the half-width between lengths of a law with these errors at lengths that were left out.
// `largest_force` is F_max [N].
void add_between(std::span<const LengthError> missed, double largest_force, StaticSpread& spread);

// Points that were left out of a fit: their errors and their predicted deviations.
struct HeldOutErrors {
  std::vector<double> residuals, widths;  // predicted - measured; sigma_F [N]
  std::vector<double> variances = {};     // within the averages [N2]; empty: single readings

  // Appends the points of `other`.
  void add(const HeldOutErrors& other);
};

// Applies a fit to points that were left out of it. A point that is slack both measured and
// predicted has no width (NaN): its small error is not evidence about points that pull.
HeldOutErrors held_out_errors(const StaticFit& fit, std::span<const StaticPoint> points);

// Returns sigma_F of each point [N]. Directions that the data do not determine are left out; q
// includes their effect.
std::vector<double> widths(const StaticFit& fit, std::span<const StaticPoint> points);

// Returns the quantiles of |error|/sigma_F of readings, at points that have a width: that of 95 %
// at most 2.5 times the root mean square. Fewer than 20 points: Student's factor times that.
Quantiles quantiles(const HeldOutErrors& errors);

// Returns the larger value of each quantile.
Quantiles wider(const Quantiles& a, const Quantiles& b);

}  // namespace sinew::identify
