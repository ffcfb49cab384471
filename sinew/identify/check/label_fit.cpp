#include "sinew/identify/check/label_fit.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "sinew/identify/actuator/static_fit.h"
#include "sinew/identify/actuator/static_groups.h"
#include "sinew/identify/actuator/static_labels.h"
#include "sinew/identify/actuator/static_slopes.h"
#include "sinew/identify/check/curves.h"
#include "sinew/identify/contest/least_squares.h"

namespace sinew::identify {

namespace {

constexpr std::size_t most_pressures = 6;  // per curve
constexpr double slack_share = 0.02;    // share of a muscle's largest force; below it may be slack
constexpr double usual_misfit = 0.01;   // scatter that sets the weight of the priors
constexpr double far_misfit = 0.04;     // points beyond it have less weight
constexpr double gain_deviation = 0.1;  // prior deviation of g
constexpr double widest_shift = 0.1;    // share of the rest length

// Residuals over free parameters, shift and gains, in this order.
class LabelProblem {
 public:
  LabelProblem(const std::vector<StaticPoint>& points,
               const std::vector<FreeParameter>& free_parameters, double atmosphere,
               const std::optional<DoubtedLabel>& doubted)
      : points_(points), free_parameters_(free_parameters), doubted_(doubted) {
    scales_ = scales_of(points, atmosphere, {});
    for (const StaticPoint& p : points) {
      double& largest = full_[p.rest_length];
      largest = std::max(largest, p.force);
    }
    for (const FreeParameter free_parameter : free_parameters_)
      parameters_.push_back(parameter_of(free_parameter, scales_));
    if (doubted_) {
      const double l = doubted_->rest_length, most = widest_shift * l;
      parameters_.push_back(
          {.name = "shift", .unit = "m", .low = -most, .high = most, .scale = 0.01 * l});
    }
    if (full_.size() > 1)
      for (std::size_t i = 0; i < full_.size(); ++i)
        parameters_.push_back(
            {.name = "gain", .unit = "1", .low = -0.5, .high = 0.5, .scale = 0.01});
  }

  const std::vector<Parameter>& parameters() const { return parameters_; }
  std::size_t count() const { return points_.size() + parameters_.size(); }

  // Returns the start: the solution of the fit without shift.
  std::vector<std::vector<double>> starts(const LabelFit& from) const {
    std::vector<double> out = from.law;
    if (doubted_) out.push_back(0);
    out.insert(out.end(), from.gains.begin(), from.gains.end());
    return {out};
  }

  // Returns two starts, with braids of different angles.
  std::vector<std::vector<double>> starts() const {
    std::vector<double> likely;
    for (const Parameter& p : parameters_) likely.push_back(p.start);
    std::vector<std::vector<double>> out{likely, likely};
    out[1][0] *= 1.2;
    out[1][1] *= 0.8;
    return out;
  }

  // Writes the residuals and, unless `by` is empty, their derivatives.
  bool operator()(std::span<const double> values, std::span<double> r, std::span<double> by) const {
    std::ranges::fill(by, 0);
    StaticSetting setting = setting_of(scales_);
    for (std::size_t i = 0; i < free_parameters_.size(); ++i)
      value_of(setting, free_parameters_[i]) = values[i];
    const double shift = doubted_ ? values[free_parameters_.size()] : 0;
    ForceSlopes slopes;
    std::size_t at = 0, gain = free_parameters_.size() + (doubted_ ? 1 : 0);
    for (const auto& [rest, largest] : full_) {
      const bool mine = doubted_ && doubted_->rest_length == rest;
      const bool is_rest_doubted = mine && !doubted_->mount;
      const MuscleLaw law(setting, scales_, is_rest_doubted ? rest + shift : rest);
      const double factor = full_.size() > 1 ? 1 + values[gain] : 1;
      for (; at < points_.size() && points_[at].rest_length == rest; ++at) {
        const StaticPoint& point = points_[at];
        const bool moves = mine && at_rest(point.length, doubted_->mount.value_or(rest));
        const double length = point.length + (moves ? shift : 0);
        const double force = law.force(length, point);
        const bool counts = !(point.force < slack_share * largest) || factor * force > 0;
        r[at] = ((counts ? factor * force : 0.0) - point.force) / largest;
        if (by.empty() || !counts) continue;
        law.write_slopes(length, point, force, slopes);
        const auto column = [&](std::size_t k) -> double& { return by[k * r.size() + at]; };
        for (std::size_t k = 0; k < free_parameters_.size(); ++k)
          column(k) = factor * value_of(slopes.by_parameter, free_parameters_[k]) / largest;
        if (mine)
          column(free_parameters_.size()) =
              factor *
              ((is_rest_doubted ? slopes.by_rest_length : 0) + (moves ? slopes.by_length : 0)) /
              largest;
        if (full_.size() > 1) column(gain) = force / largest;
      }
      gain += full_.size() > 1 ? 1 : 0;
    }
    add_priors(values, r, by);
    return std::ranges::all_of(r, [](double x) { return std::isfinite(x); });
  }

 private:
  void add_priors(std::span<const double> values, std::span<double> r, std::span<double> by) const {
    for (std::size_t i = 0; i < parameters_.size(); ++i) {
      std::optional<Prior> prior;
      if (parameters_[i].name == "gain") prior = Prior{0, gain_deviation};
      if (i < free_parameters_.size()) prior = prior_of(free_parameters_[i], scales_);
      const std::size_t row = points_.size() + i;
      r[row] = prior ? usual_misfit * prior->away(values[i]) / prior->deviation : 0;
      if (prior && !by.empty())
        by[i * r.size() + row] = usual_misfit / prior->deviation_at(values[i]);
    }
  }

  const std::vector<StaticPoint>& points_;  // sorted by rest length
  std::vector<FreeParameter> free_parameters_;
  std::optional<DoubtedLabel> doubted_;
  StaticScales scales_;
  std::map<double, double> full_;  // largest force of each muscle [N]
  std::vector<Parameter> parameters_;
};

LabelFit solved_labels(const LabelProblem& problem, const std::vector<std::vector<double>>& starts,
                       std::size_t points, std::size_t free_parameters, bool doubted) {
  const Residuals residuals = [&](std::span<const double> p, std::span<double> r) {
    return problem(p, r, {});
  };
  const Solution found = least_squares_from(
      residuals, problem.count(), problem.parameters(), starts,
      {.outlier = far_misfit, .correlated = true, .most_steps = 60, .slopes = std::cref(problem)});
  LabelFit out;
  double square = 0;
  for (std::size_t i = 0; i < points; ++i) square += found.residuals[i] * found.residuals[i];
  out.rms = std::sqrt(square / static_cast<double>(points));
  const auto middle = found.values.begin() + static_cast<std::ptrdiff_t>(free_parameters);
  out.law.assign(found.values.begin(), middle);
  out.gains.assign(middle + (doubted ? 1 : 0), found.values.end());
  if (!doubted) return out;
  const Estimate& e = found.estimates[free_parameters];
  out.shift = e.value;
  out.error = e.at_bound ? unbounded : e.standard_error;
  return out;
}

}  // namespace

std::vector<StaticPoint> few_points(const std::vector<StaticPoint>& points) {
  std::vector<StaticPoint> out;
  for (const ForceCurve& c : curves_of(points)) {
    const std::size_t n = c.pressure.size(), take = std::min(n, most_pressures);
    for (std::size_t k = 0; k < take; ++k) {
      const std::size_t i = take > 1 ? k * (n - 1) / (take - 1) : 0;
      out.push_back({.length = c.length,
                     .pressure = c.pressure[i],
                     .force = c.force[i],
                     .rest_length = c.rest_length,
                     .branch = c.branch});
    }
  }
  return out;
}

LabelFit fit_labels(const std::vector<StaticPoint>& points,
                    const std::vector<FreeParameter>& free_parameters, double atmosphere) {
  const LabelProblem problem(points, free_parameters, atmosphere, {});
  return solved_labels(problem, problem.starts(), points.size(), free_parameters.size(), false);
}

LabelFit fit_labels(const std::vector<StaticPoint>& points,
                    const std::vector<FreeParameter>& free_parameters, double atmosphere,
                    const DoubtedLabel& doubted, const LabelFit& from) {
  const LabelProblem problem(points, free_parameters, atmosphere, doubted);
  return solved_labels(problem, problem.starts(from), points.size(), free_parameters.size(), true);
}

}  // namespace sinew::identify
