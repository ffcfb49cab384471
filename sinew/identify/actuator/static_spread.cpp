#include "sinew/identify/actuator/static_spread.h"

#include <algorithm>
#include <cmath>

#include "sinew/identify/actuator/static_labels.h"
#include "sinew/identify/actuator/static_slopes.h"
#include "sinew/identify/contest/score.h"

namespace sinew::identify {

namespace {

constexpr std::size_t few = 20;        // fewer points give no empirical 95th percentile
constexpr double widest = 2.5;         // half-width of 95 %, in root mean squares
constexpr double slack_share = 0.005;  // share of the largest force; less counts as slack
constexpr double prior_error = 0.08;   // kappa_d0: share of the largest force per rest length
constexpr int prior_freedom = 1;       // nu_0

}  // namespace

void add_between(std::span<const LengthError> missed, double largest_force, StaticSpread& spread) {
  double shown = 0;
  for (const LengthError& m : missed) shown += m.square / (m.away * m.away);
  const double squares = prior_freedom * prior_error * prior_error + std::max(0.0, shown);
  const int freedom = prior_freedom + static_cast<int>(missed.size());
  const double c = std::sqrt(squares / freedom);
  spread.between_68 = t_quantile_68(freedom) * c * largest_force;
  spread.between_95 = t_quantile(freedom) * c * largest_force;
}

void HeldOutErrors::add(const HeldOutErrors& other) {
  residuals.insert(residuals.end(), other.residuals.begin(), other.residuals.end());
  widths.insert(widths.end(), other.widths.begin(), other.widths.end());
}

std::vector<double> widths(const StaticFit& fit, const StaticScales& scales,
                           std::span<const StaticPoint> points) {
  const std::vector<RestLengthError>& known = fit.setting.rest_lengths;
  const std::vector<double>& covariance = fit.solution.covariance;
  std::vector<double> out;
  ForceSlopes slopes;
  for (const StaticPoint& point : points) {
    const MuscleLaw law(fit.setting, scales, point.rest_length);
    const double length = fitted_length(fit.setting, point), force = law.force(length, point);
    law.write_slopes(length, point, force, slopes);
    const double pulls = force > 0 ? 1 : 0;
    std::vector<double> gradient;
    for (const FreeParameter free_parameter : fit.free_parameters)
      gradient.push_back(pulls * value_of(slopes.by_parameter, free_parameter));
    bool is_known = known.empty();
    for (const RestLengthError& r : known) {
      const bool mine = r.labelled == point.rest_length;
      is_known = is_known || mine;
      if (r.is_fitted()) gradient.push_back(mine ? pulls * slopes.by_label(point) : 0);
    }
    double sum = 0;
    for (std::size_t i = 0; i < gradient.size(); ++i)
      for (std::size_t k = 0; k < gradient.size(); ++k)
        if (const double c = covariance[i * gradient.size() + k]; std::isfinite(c))
          sum += c * gradient[i] * gradient[k];
    double square = fit.scatter * fit.scatter + std::max(sum, 0.0);
    // A muscle that was not fitted has an additional error of its rest length.
    if (!is_known)
      square +=
          std::pow(pulls * slopes.by_label(point) * rest_length_deviation(point.rest_length), 2);
    out.push_back(std::sqrt(square));
  }
  return out;
}

HeldOutErrors held_out_errors(const StaticFit& fit, const StaticScales& scales,
                              std::span<const StaticPoint> points) {
  HeldOutErrors out{residuals_of(fit.setting, scales, points), widths(fit, scales, points)};
  const double slack = slack_share * scales.full_scale;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].force < slack && points[i].force + out.residuals[i] < slack)
      out.widths[i] = std::nan("");
  return out;
}

Quantiles quantiles(const HeldOutErrors& errors) {
  std::vector<double> z;
  double square = 0;
  for (std::size_t i = 0; i < errors.residuals.size(); ++i) {
    if (!std::isfinite(errors.widths[i])) continue;
    z.push_back(std::abs(errors.residuals[i]) / errors.widths[i]);
    square += z.back() * z.back();
  }
  Quantiles out{.points = z.size()};
  if (out.points == 0) return out;
  square /= static_cast<double>(out.points);
  if (out.points < few) {
    out.q95 = std::sqrt(square) * t_quantile(static_cast<int>(out.points));
    out.q68 = std::sqrt(square);
    return out;
  }
  out.q68 = half_width_of(z, 0.68);
  out.q95 = std::min(half_width_of(z, 0.95), widest * std::sqrt(square));
  return out;
}

Quantiles wider(const Quantiles& a, const Quantiles& b) {
  return {std::max(a.q68, b.q68), std::max(a.q95, b.q95), a.points + b.points};
}

}  // namespace sinew::identify
