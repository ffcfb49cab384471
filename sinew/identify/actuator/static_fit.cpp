#include "sinew/identify/actuator/static_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "sinew/actuator/hysteresis.h"
#include "sinew/actuator/tension.h"
#include "sinew/identify/actuator/static_widen.h"
#include "sinew/identify/data/quality.h"
#include "sinew/identify/fit/refusal.h"

namespace sinew::identify {

namespace {

constexpr double common_deviation = 1e-3;  // of the sum of all d/L_0
constexpr double slack_below = 0.005;      // of the full scale
constexpr double first_scatter = 0.005, least_scatter = 0.001, most_scatter = 0.02;
constexpr double outlier = 4;        // scatters
constexpr double prior_rules = 0.6;  // of its deviation: an error that is larger says nothing new

// Force as the law has it: below zero where the muscle would push.
double pull(const actuator::Actuator& a, const StaticPoint& point, double length,
            double atmosphere) {
  double p = point.pressure;
  if (a.hysteresis.half_width > 0)
    p -= static_cast<int>(point.branch) * actuator::half_width(a, length, p);
  return actuator::tension(a, length, 0, p, atmosphere);
}

Parameter rest_length_parameter(double labelled) {
  const double most = 10 * rest_length_deviation(labelled);
  return {.name = fmt::format("{}{:.4g}mm", rest_length_error, 1e3 * labelled),
          .unit = "m",
          .low = -most,
          .high = most,
          .scale = 0.02 * labelled};
}

class Problem {
 public:
  Problem(const std::vector<Knob>& knobs, std::span<const StaticPoint> points,
          const StaticScales& scales)
      : knobs_(knobs), points_(points), scales_(scales) {
    for (const Knob knob : knobs) {
      parameters_.push_back(parameter_of(knob, scales));
      priors_.push_back(prior_of(knob, scales));
    }
    for (const StaticPoint& p : points)
      if (std::ranges::find(muscles_, p.rest_length) == muscles_.end())
        muscles_.push_back(p.rest_length);
    if (muscles_.size() < 2) muscles_.clear();
    for (const double labelled : muscles_) {
      parameters_.push_back(rest_length_parameter(labelled));
      priors_.push_back(Prior{0, rest_length_deviation(labelled)});
    }
  }

  std::size_t count() const {
    return points_.size() + parameters_.size() + (muscles_.empty() ? 0 : 1);
  }
  const std::vector<Parameter>& parameters() const { return parameters_; }
  const std::optional<Prior>& prior(std::size_t i) const { return priors_[i]; }

  StaticSetting setting(std::span<const double> values) const {
    StaticSetting out = setting_of(scales_);
    for (std::size_t i = 0; i < knobs_.size(); ++i) value_of(out, knobs_[i]) = values[i];
    for (std::size_t i = 0; i < muscles_.size(); ++i)
      out.rest_lengths.push_back({muscles_[i], values[knobs_.size() + i]});
    return out;
  }

  // The values of a setting.
  std::vector<double> values(const StaticSetting& setting) const {
    std::vector<double> out;
    StaticSetting from = setting;
    for (const Knob knob : knobs_) out.push_back(value_of(from, knob));
    for (const double m : muscles_) out.push_back(rest_length_of(setting, m) - m);
    return out;
  }

  Residuals residuals(double scatter) const {
    return [this, scatter](std::span<const double> values, std::span<double> r) {
      fill(setting(values), std::max(slack_below * scales_.full_scale, outlier * scatter), r);
      for (std::size_t i = 0; i < priors_.size(); ++i) {
        double& out = r[points_.size() + i];
        out = 0;
        if (!priors_[i]) continue;
        const Prior& prior = *priors_[i];
        const double off =
            prior.logarithmic ? std::log(values[i] / prior.mean) : values[i] - prior.mean;
        out = scatter * off / prior.deviation;
      }
      if (!muscles_.empty()) r.back() = scatter * in_common(values) / common_deviation;
      return std::all_of(r.begin(), r.end(), [](double x) { return std::isfinite(x); });
    };
  }

 private:
  // Returns the sum of d/L_0: what all labels have in common.
  double in_common(std::span<const double> values) const {
    double sum = 0;
    for (std::size_t i = 0; i < muscles_.size(); ++i)
      sum += values[knobs_.size() + i] / muscles_[i];
    return sum;
  }

  // Points below `slack` may be slack: a law that pushes there is no worse than one that ends.
  void fill(const StaticSetting& setting, double slack, std::span<double> r) const {
    double labelled = 0;
    actuator::Actuator a;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const StaticPoint& point = points_[i];
      if (point.rest_length != labelled) {
        labelled = point.rest_length;
        a = scaled(setting, scales_, labelled);
      }
      const double f = pull(a, point, fitted_length(setting, point), scales_.atmosphere);
      r[i] = (point.force > slack ? f : std::max(f, 0.0)) - point.force;
    }
  }

  const std::vector<Knob>& knobs_;
  std::span<const StaticPoint> points_;
  const StaticScales& scales_;
  std::vector<double> muscles_;        // whose rest lengths are fitted with the law
  std::vector<Parameter> parameters_;  // of the knobs, of the muscles
  std::vector<std::optional<Prior>> priors_;
};

// Spread of what the fit leaves, of the points that are taut.
double scatter_of(std::span<const double> residuals, std::span<const StaticPoint> points,
                  const StaticScales& scales) {
  std::vector<double> taut;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].force > slack_below * scales.full_scale) taut.push_back(std::abs(residuals[i]));
  const double s = taut.empty() ? 0 : 1.4826 * median(taut);
  return std::clamp(s, least_scatter * scales.full_scale, most_scatter * scales.full_scale);
}

// Starts: the likely values, with braids of two angles.
std::vector<std::vector<double>> starts_of(std::span<const Parameter> parameters,
                                           const std::vector<Knob>& knobs) {
  std::vector<double> likely;
  for (const Parameter& p : parameters) likely.push_back(p.start);
  std::vector<std::vector<double>> out{likely};
  if (knobs.empty() || knobs[0] != Knob::thread_length) return out;
  out.push_back(likely);
  out.back()[0] *= 1.2;
  out.back()[1] *= 0.8;
  return out;
}

}  // namespace

double fitted_length(const StaticSetting& setting, const StaticPoint& point) {
  if (setting.rest_lengths.empty() || !at_rest(point.length, point.rest_length))
    return point.length;
  return point.length + (rest_length_of(setting, point.rest_length) - point.rest_length);
}

double predicted(const StaticSetting& setting, const StaticScales& scales,
                 const StaticPoint& point) {
  return std::max(0.0, pull(scaled(setting, scales, point.rest_length), point,
                            fitted_length(setting, point), scales.atmosphere));
}

std::vector<double> misses(const StaticSetting& setting, const StaticScales& scales,
                           std::span<const StaticPoint> points) {
  std::vector<double> out;
  for (const StaticPoint& point : points)
    out.push_back(predicted(setting, scales, point) - point.force);
  return out;
}

StaticFit fit_static(const std::vector<Knob>& knobs, std::span<const StaticPoint> points,
                     const StaticScales& scales, const StaticFit* start, double tolerance) {
  if (points.size() < knobs.size() + 2)
    throw Refusal("data", fmt::format("{} points", points.size()),
                  fmt::format("at least {} for {} parameters", knobs.size() + 2, knobs.size()),
                  "more measurements, or a simpler model");
  StaticFit out{.knobs = knobs};
  Problem problem(out.knobs, points, scales);
  std::vector<Parameter> from = problem.parameters();
  if (start) {
    out.scatter = start->scatter;
    const std::vector<double> values = problem.values(start->setting);
    for (std::size_t i = 0; i < from.size(); ++i) from[i].start = values[i];
  } else {
    const Solution first =
        least_squares_from(problem.residuals(first_scatter * scales.full_scale), problem.count(),
                           from, starts_of(from, knobs), {.tolerance = std::max(tolerance, 1e-9)});
    out.scatter = scatter_of(first.residuals, points, scales);
    for (std::size_t i = 0; i < from.size(); ++i) from[i].start = first.values[i];
  }
  out.solution =
      least_squares(problem.residuals(out.scatter), problem.count(), from,
                    {.outlier = outlier * out.scatter, .correlated = true, .tolerance = tolerance});
  out.setting = problem.setting(out.solution.values);
  if (!start)
    widen(problem.residuals(out.scatter), problem.parameters(), problem.count(), points.size(),
          out.scatter, outlier, out.solution);
  out.solution.residuals.resize(points.size());
  for (const double r : out.solution.residuals) out.outliers += std::abs(r) > outlier * out.scatter;

  for (std::size_t i = 0; i < knobs.size(); ++i) {
    Estimate& e = out.solution.estimates[i];
    const auto& prior = problem.prior(i);
    if (!prior || e.at_bound) continue;
    const double deviation = prior->logarithmic ? prior->deviation * e.value : prior->deviation;
    if (e.standard_error < prior_rules * deviation) continue;
    e.identifiable = false;
    out.unknown.push_back(knobs[i]);
  }
  return out;
}

StaticFit fit_by_ratio(std::span<const StaticPoint> points, const StaticScales& scales) {
  StaticScales of_braid = scales;
  StaticSetting ideal = setting_of(scales);
  if (!scales.braid) ideal = fit_static({Knob::thread_length, Knob::turns}, points, scales).setting;
  of_braid.braid = ideal.actuator.braid;

  // Sums per nominal pressure, of what pulls.
  std::vector<double> pressures;
  for (const StaticPoint& p : points) pressures.push_back(p.pressure);
  const double range = largest(pressures) - smallest(pressures);
  const std::vector<int> group = groups_of(pressures, 0.015 * range, 0.1 * range);
  struct Sums {
    double product = 0, square = 0, pressure = 0, count = 0;
  };
  std::map<int, Sums> sums;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double f = predicted(ideal, of_braid, points[i]);
    if (points[i].force < slack_below * scales.full_scale || !(f > 0)) continue;
    Sums& s = sums[group[i]];
    s.product += points[i].force * f;
    s.square += f * f;
    s.pressure += points[i].pressure;
    ++s.count;
  }

  StaticFit out{.knobs = {Knob::eff_constant, Knob::eff_linear, Knob::eff_quadratic}};
  std::vector<Parameter> parameters;
  for (const Knob knob : out.knobs) parameters.push_back(parameter_of(knob, of_braid));
  const Residuals off = [&](std::span<const double> c, std::span<double> r) {
    std::size_t i = 0;
    for (const auto& [g, s] : sums) {
      const double p = s.pressure / s.count;
      r[i++] = (c[0] + p * (c[1] + p * c[2])) - s.product / s.square;
    }
    return true;
  };
  out.solution = least_squares(off, sums.size(), parameters);
  out.setting = setting_of(of_braid);
  for (std::size_t i = 0; i < out.knobs.size(); ++i)
    value_of(out.setting, out.knobs[i]) = out.solution.values[i];
  out.solution.residuals = misses(out.setting, of_braid, points);
  out.scatter = scatter_of(out.solution.residuals, points, scales);
  return out;
}

}  // namespace sinew::identify
