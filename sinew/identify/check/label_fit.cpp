#include "sinew/identify/check/label_fit.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "sinew/identify/actuator/static_fit.h"
#include "sinew/identify/actuator/static_groups.h"
#include "sinew/identify/actuator/static_labels.h"
#include "sinew/identify/check/curves.h"
#include "sinew/identify/fit/least_squares.h"

namespace sinew::identify {

namespace {

constexpr std::size_t most_pressures = 6;  // of a curve
constexpr double slack_share = 0.02;       // of a muscle's largest force: below, it may be slack
constexpr double usual_misfit = 0.01;      // that the priors are weighed with
constexpr double far_misfit = 0.04;        // beyond it points count less
constexpr double gain_deviation = 0.1;     // of g
constexpr double widest_shift = 0.1;       // of a rest length

// The residuals of points over knobs, shift and gains, in this order.
class LabelProblem {
 public:
  LabelProblem(const std::vector<StaticPoint>& points, const std::vector<Knob>& knobs,
               double atmosphere, const std::optional<DoubtedLabel>& doubted)
      : points_(points), knobs_(knobs), doubted_(doubted) {
    scales_ = scales_of(points, atmosphere, {});
    for (const StaticPoint& p : points) {
      double& largest = full_[p.rest_length];
      largest = std::max(largest, p.force);
    }
    for (const Knob knob : knobs_) parameters_.push_back(parameter_of(knob, scales_));
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

  // Where the fit that believes the labels has ended.
  std::vector<std::vector<double>> starts(const LabelFit& from) const {
    std::vector<double> out = from.law;
    if (doubted_) out.push_back(0);
    out.insert(out.end(), from.gains.begin(), from.gains.end());
    return {out};
  }

  // Two braids of different angles to begin with.
  std::vector<std::vector<double>> starts() const {
    std::vector<double> likely;
    for (const Parameter& p : parameters_) likely.push_back(p.start);
    std::vector<std::vector<double>> out{likely, likely};
    out[1][0] *= 1.2;
    out[1][1] *= 0.8;
    return out;
  }

  bool operator()(std::span<const double> values, std::span<double> r) const {
    StaticSetting setting = setting_of(scales_);
    for (std::size_t i = 0; i < knobs_.size(); ++i) value_of(setting, knobs_[i]) = values[i];
    const double shift = doubted_ ? values[knobs_.size()] : 0;
    std::size_t at = 0, gain = knobs_.size() + (doubted_ ? 1 : 0);
    for (const auto& [rest, largest] : full_) {
      const bool mine = doubted_ && doubted_->rest_length == rest;
      const double now = mine && !doubted_->mount ? rest + shift : rest;
      const actuator::Actuator a = scaled(setting, scales_, now);
      const double factor = full_.size() > 1 ? 1 + values[gain++] : 1;
      for (; at < points_.size() && points_[at].rest_length == rest; ++at)
        r[at] = miss(a, points_[at], mine ? shift : 0, factor, largest);
    }
    add_priors(values, r);
    return std::ranges::all_of(r, [](double x) { return std::isfinite(x); });
  }

 private:
  double miss(const actuator::Actuator& a, const StaticPoint& p, double shift, double factor,
              double largest) const {
    double length = p.length;
    const double label = doubted_ ? doubted_->mount.value_or(doubted_->rest_length) : 0;
    if (shift != 0 && at_rest(length, label)) length += shift;
    double force = factor * law_force(a, length, p, scales_.atmosphere);
    if (p.force < slack_share * largest) force = std::max(force, 0.0);
    return (force - p.force) / largest;
  }

  void add_priors(std::span<const double> values, std::span<double> r) const {
    for (std::size_t i = 0; i < parameters_.size(); ++i) {
      double& out = r[points_.size() + i];
      out = 0;
      if (parameters_[i].name == "gain") out = usual_misfit * values[i] / gain_deviation;
      if (i >= knobs_.size()) continue;
      if (const auto prior = prior_of(knobs_[i], scales_))
        out = usual_misfit *
              (prior->logarithmic ? std::log(values[i] / prior->mean) : values[i] - prior->mean) /
              prior->deviation;
    }
  }

  const std::vector<StaticPoint>& points_;  // by rest length
  std::vector<Knob> knobs_;
  std::optional<DoubtedLabel> doubted_;
  StaticScales scales_;
  std::map<double, double> full_;  // of each muscle its largest force [N]
  std::vector<Parameter> parameters_;
};

LabelFit solved_labels(const LabelProblem& problem, const std::vector<std::vector<double>>& starts,
                       std::size_t points, std::size_t knobs, bool doubted) {
  const Residuals residuals = [&](std::span<const double> p, std::span<double> r) {
    return problem(p, r);
  };
  const Solution found =
      least_squares_from(residuals, problem.count(), problem.parameters(), starts,
                         {.outlier = far_misfit, .correlated = true, .most_steps = 60});
  LabelFit out;
  double square = 0;
  for (std::size_t i = 0; i < points; ++i) square += found.residuals[i] * found.residuals[i];
  out.rms = std::sqrt(square / static_cast<double>(points));
  const auto middle = found.values.begin() + static_cast<std::ptrdiff_t>(knobs);
  out.law.assign(found.values.begin(), middle);
  out.gains.assign(middle + (doubted ? 1 : 0), found.values.end());
  if (!doubted) return out;
  const Estimate& e = found.estimates[knobs];
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

LabelFit fit_labels(const std::vector<StaticPoint>& points, const std::vector<Knob>& knobs,
                    double atmosphere) {
  const LabelProblem problem(points, knobs, atmosphere, {});
  return solved_labels(problem, problem.starts(), points.size(), knobs.size(), false);
}

LabelFit fit_labels(const std::vector<StaticPoint>& points, const std::vector<Knob>& knobs,
                    double atmosphere, const DoubtedLabel& doubted, const LabelFit& from) {
  const LabelProblem problem(points, knobs, atmosphere, doubted);
  return solved_labels(problem, problem.starts(from), points.size(), knobs.size(), true);
}

}  // namespace sinew::identify
