#include "sinew/identify/actuator/static_spread.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "sinew/identify/actuator/static_labels.h"
#include "sinew/identify/fit/score.h"

namespace sinew::identify {

namespace {

constexpr std::size_t few = 20;  // points below which an order says little of the 95th percentile
constexpr double slack_share = 0.005;    // of the largest force: less is no pull
constexpr double gradient_step = 1e-4;   // of a parameter's scale
constexpr double believed_error = 0.08;  // c_0: share of the largest force per rest length
constexpr int believed_freedom = 1;      // nu_0

// Returns the variance of the mean force by the parameters, g' Cov g  [N2].
double by_parameters(const std::vector<std::vector<double>>& gradient, std::size_t point,
                     const std::vector<double>& covariance) {
  const std::size_t n = gradient.size();
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k)
      if (const double c = covariance[i * n + k]; std::isfinite(c))
        sum += c * gradient[i][point] * gradient[k][point];
  return std::max(sum, 0.0);
}

// The setting with one muscle longer or shorter than it has it.
StaticSetting with_error(const StaticSetting& setting, double labelled, double more) {
  StaticSetting out = setting;
  const auto at = std::ranges::find(out.rest_lengths, labelled, &RestLengthError::labelled);
  if (at == out.rest_lengths.end())
    out.rest_lengths.push_back({labelled, more});
  else
    at->error += more;
  return out;
}

// Rest lengths of points that the fit did not see; none where nobody says which muscles it saw.
std::set<double> unknown_muscles(const std::vector<RestLengthError>& known,
                                 std::span<const StaticPoint> points) {
  std::set<double> out;
  if (known.empty()) return out;
  for (const StaticPoint& p : points)
    if (std::ranges::find(known, p.rest_length, &RestLengthError::labelled) == known.end())
      out.insert(p.rest_length);
  return out;
}

}  // namespace

void add_between(std::span<const MissedLength> missed, double largest_force, StaticSpread& spread) {
  double shown = 0;
  for (const MissedLength& m : missed) shown += m.square / (m.away * m.away);
  const double squares = believed_freedom * believed_error * believed_error + std::max(0.0, shown);
  const int freedom = believed_freedom + static_cast<int>(missed.size());
  const double c = std::sqrt(squares / freedom);
  spread.between_68 = t_quantile_68(freedom) * c * largest_force;
  spread.between_95 = t_quantile(freedom) * c * largest_force;
}

void Unseen::add(const Unseen& other) {
  residuals.insert(residuals.end(), other.residuals.begin(), other.residuals.end());
  widths.insert(widths.end(), other.widths.begin(), other.widths.end());
}

std::vector<double> widths(const StaticFit& fit, const StaticScales& scales,
                           std::span<const StaticPoint> points) {
  std::vector<std::vector<double>> gradient;
  const auto slope = [&](const StaticSetting& up, const StaticSetting& down, double step) {
    std::vector<double> out = misses(up, scales, points);
    const std::vector<double> below = misses(down, scales, points);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = (out[i] - below[i]) / (2 * step);
    return out;
  };
  for (const Knob knob : fit.knobs) {
    const double step = gradient_step * parameter_of(knob, scales).scale;
    StaticSetting up = fit.setting, down = fit.setting;
    value_of(up, knob) += step;
    value_of(down, knob) -= step;
    gradient.push_back(slope(up, down, step));
  }
  const auto by_rest_length = [&](double labelled) {
    const double step = 0.01 * rest_length_deviation(labelled);
    return slope(with_error(fit.setting, labelled, step), with_error(fit.setting, labelled, -step),
                 step);
  };
  const std::vector<RestLengthError>& known = fit.setting.rest_lengths;
  for (const RestLengthError& r : known)
    if (r.doubted()) gradient.push_back(by_rest_length(r.labelled));

  std::vector<double> square;
  for (std::size_t i = 0; i < points.size(); ++i)
    square.push_back(fit.scatter * fit.scatter +
                     by_parameters(gradient, i, fit.solution.covariance));
  // A muscle that was not fitted has an error of its own.
  for (const double labelled : unknown_muscles(known, points)) {
    const std::vector<double> g = by_rest_length(labelled);
    for (std::size_t i = 0; i < points.size(); ++i)
      square[i] += std::pow(g[i] * rest_length_deviation(labelled), 2);
  }
  for (double& s : square) s = std::sqrt(s);
  return square;
}

Unseen unseen_by(const StaticFit& fit, const StaticScales& scales,
                 std::span<const StaticPoint> points) {
  Unseen out{misses(fit.setting, scales, points), widths(fit, scales, points)};
  const double slack = slack_share * scales.full_scale;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].force < slack && points[i].force + out.residuals[i] < slack)
      out.widths[i] = std::nan("");
  return out;
}

Quantiles quantiles(const Unseen& unseen) {
  std::vector<double> z;
  double square = 0;
  for (std::size_t i = 0; i < unseen.residuals.size(); ++i) {
    if (!std::isfinite(unseen.widths[i])) continue;
    z.push_back(std::abs(unseen.residuals[i]) / unseen.widths[i]);
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
  out.q95 = half_width_of(z, 0.95);
  return out;
}

Quantiles wider(const Quantiles& a, const Quantiles& b) {
  return {std::max(a.q68, b.q68), std::max(a.q95, b.q95), a.points + b.points};
}

}  // namespace sinew::identify
