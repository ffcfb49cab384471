#include "sinew/identify/actuator/static_spread.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sinew/identify/actuator/static_labels.h"
#include "sinew/identify/actuator/static_slopes.h"
#include "sinew/identify/contest/score.h"

namespace sinew::identify {

namespace {

constexpr std::size_t few = 20;        // fewer points give no empirical 95th percentile
constexpr double widest = 2.5;         // half-width of 95 %, in root mean squares
constexpr double slack_share = 0.005;  // share of the largest force; less counts as slack
constexpr double prior_error = 0.1;    // kappa_d0
constexpr double prior_weight = 3;     // 3 in the formula for w

// Returns the values that divide a normal distribution into equally probable parts, each at the
// middle of its part.
std::vector<double> normal_nodes() {
  constexpr int parts = 100;
  std::vector<double> out;
  for (int k = 0; k < parts; ++k) {
    const double share = (k + 0.5) / parts;
    double low = -10, high = 10;
    for (int step = 0; step < 60; ++step) {
      const double middle = 0.5 * (low + high);
      (0.5 * std::erfc(-middle / std::numbers::sqrt2) < share ? low : high) = middle;
    }
    out.push_back(low);
  }
  return out;
}

}  // namespace

std::vector<double> errors_of_readings(std::span<const double> errors,
                                       std::span<const double> variances) {
  static const std::vector<double> nodes = normal_nodes();
  std::vector<double> out;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double deviation = i < variances.size() ? std::sqrt(variances[i]) : 0;
    if (!(deviation > 0)) {
      out.push_back(errors[i]);
      continue;
    }
    for (const double node : nodes) out.push_back(errors[i] + deviation * node);
  }
  return out;
}

void add_between(std::span<const LengthError> missed, double largest_force, StaticSpread& spread) {
  const auto count = static_cast<double>(missed.size());
  const double power = std::pow(count, 4), weight = power / (power + prior_weight);
  double shown = 0;
  for (const LengthError& m : missed) shown += m.square / m.away / count;
  const double square = (1 - weight) * prior_error * prior_error + weight * std::max(0.0, shown);
  spread.between_68 = std::sqrt(square) * largest_force;
}

void HeldOutErrors::add(const HeldOutErrors& other) {
  residuals.insert(residuals.end(), other.residuals.begin(), other.residuals.end());
  widths.insert(widths.end(), other.widths.begin(), other.widths.end());
  variances.insert(variances.end(), other.variances.begin(), other.variances.end());
}

std::vector<double> widths(const StaticFit& fit, std::span<const StaticPoint> points) {
  const std::vector<RestLengthError>& known = fit.setting.rest_lengths;
  const std::vector<double>& covariance = fit.solution.covariance;
  std::vector<double> out;
  ForceSlopes slopes;
  for (const StaticPoint& point : points) {
    const MuscleLaw law(fit.setting, fit.scales, point.rest_length);
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
    double square = fit.scatter * fit.scatter + fit.variance + std::max(sum, 0.0);
    // A muscle that was not fitted has an additional error of its rest length.
    if (!is_known)
      square +=
          std::pow(pulls * slopes.by_label(point) * rest_length_deviation(point.rest_length), 2);
    out.push_back(std::sqrt(square));
  }
  return out;
}

HeldOutErrors held_out_errors(const StaticFit& fit, std::span<const StaticPoint> points) {
  HeldOutErrors out{residuals_of(fit, points), widths(fit, points)};
  for (const StaticPoint& p : points) out.variances.push_back(p.variance);
  const double slack = slack_share * fit.scales.full_scale;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].force < slack && points[i].force + out.residuals[i] < slack)
      out.widths[i] = std::nan("");
  return out;
}

Quantiles quantiles(const HeldOutErrors& errors) {
  std::vector<double> relative, variances;
  double square = 0;
  for (std::size_t i = 0; i < errors.residuals.size(); ++i) {
    const double width = errors.widths[i];
    if (!std::isfinite(width)) continue;
    relative.push_back(errors.residuals[i] / width);
    variances.push_back(i < errors.variances.size() ? errors.variances[i] / (width * width) : 0);
    square += relative.back() * relative.back() + variances.back();
  }
  Quantiles out{.points = relative.size()};
  if (out.points == 0) return out;
  square /= static_cast<double>(out.points);
  if (out.points < few) {
    out.q95 = std::sqrt(square) * t_quantile(static_cast<int>(out.points));
    out.q68 = std::sqrt(square);
    return out;
  }
  const std::vector<double> z = errors_of_readings(relative, variances);
  out.q68 = half_width_of(z, 0.68);
  out.q95 = std::min(half_width_of(z, 0.95), widest * std::sqrt(square));
  return out;
}

Quantiles wider(const Quantiles& a, const Quantiles& b) {
  return {std::max(a.q68, b.q68), std::max(a.q95, b.q95), a.points + b.points};
}

}  // namespace sinew::identify
