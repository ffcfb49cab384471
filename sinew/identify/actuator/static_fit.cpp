#include "sinew/identify/actuator/static_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <span>

#include "sinew/actuator/hysteresis.h"
#include "sinew/actuator/tension.h"
#include "sinew/identify/actuator/static_groups.h"
#include "sinew/identify/actuator/static_labels.h"
#include "sinew/identify/actuator/static_slopes.h"
#include "sinew/identify/contest/bounds.h"
#include "sinew/identify/contest/least_squares.h"
#include "sinew/identify/contest/matrix.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/data/quality.h"

namespace sinew::identify {

namespace {

// --- intervals of a static fit whose points scatter differently ---

// The scatter differs from point to point: a length error of 0.1 mm matters most where the
// force is steepest. Each point's own residual is the measure (White's standard errors, with HC3's
// correction for the leverage of a point). Readings of one setting share the law's error there, so
// they are summed before squaring. Intervals are only widened, never narrowed.
//
// The first of `count` residuals are measurements with these settings and weights, the others are
// priors. A residual beyond `outlier` scatters counts as that many.
void widen(const Slopes& slopes, std::span<const Parameter> parameters, std::size_t count,
           std::span<const int> settings, std::span<const double> weights, double scatter,
           double outlier, Solution& solution) {
  const std::size_t n = solution.values.size();
  if (n == 0) return;
  std::vector<double> left(count);
  Matrix j(count, n);  // per scale
  slopes(solution.values, left, {j.column(0).data(), count * n});
  const auto root = [&](std::size_t r) { return r < weights.size() ? std::sqrt(weights[r]) : 1.0; };
  for (std::size_t i = 0; i < n; ++i) {
    const bool is_held = solution.estimates[i].at_bound || !solution.estimates[i].free;
    for (std::size_t r = 0; r < count; ++r) j(r, i) *= is_held ? 0 : parameters[i].scale * root(r);
  }
  const Matrix pull = product(j, inverse_where_determined(transposed_product(j, j)));
  const std::size_t points = settings.size();
  const auto setting = [&](std::size_t r) {
    return r < points ? static_cast<std::size_t>(settings[r]) : r;
  };
  std::vector<double> leverage(count);  // leverage of each setting
  for (std::size_t r = 0; r < points; ++r)
    for (std::size_t i = 0; i < n; ++i) leverage[setting(r)] += pull(r, i) * j(r, i);
  Matrix moved(count, n);  // change of each parameter due to each setting's residuals, in its scale
  for (std::size_t r = 0; r < count; ++r) {
    double off = r < points ? solution.residuals[r] : scatter;
    off = std::clamp(off, -outlier * scatter, outlier * scatter);
    if (r < points) off /= std::max(0.2, 1 - leverage[setting(r)]);
    for (std::size_t i = 0; i < n; ++i) moved(setting(r), i) += off * root(r) * pull(r, i);
  }
  std::vector<double> variance(n);  // one per parameter, in its scale
  for (std::size_t r = 0; r < count; ++r)
    for (std::size_t i = 0; i < n; ++i) variance[i] += moved(r, i) * moved(r, i);
  const int distinct = settings.empty() ? 0 : *std::ranges::max_element(settings) + 1;
  double readings = 0;  // as solution.freedom counts them, priors included
  for (std::size_t r = 0; r < count; ++r) readings += r < weights.size() ? weights[r] : 1;
  const auto priors = static_cast<int>(count - points);
  solution.freedom -= static_cast<int>(std::lround(readings)) - distinct - priors;
  const double t = t_quantile(std::max(1, solution.freedom));
  for (std::size_t i = 0; i < n; ++i) {
    Estimate& e = solution.estimates[i];
    const double scale = parameters[i].scale;
    const double own = std::sqrt(variance[i]) * scale;
    if (e.at_bound || !(own > e.standard_error)) continue;
    e.set_interval(own, t);
    e.identifiable = t * own <= std::max(std::abs(e.value), scale);
  }
}

constexpr double slack_below = 0.005;  // share of the full scale
constexpr double first_scatter = 0.005, least_scatter = 0.001, most_scatter = 0.02;
constexpr double outlier = 4;        // in scatters
constexpr double prior_rules = 0.6;  // share of the prior deviation; larger: no information

class Problem {
 public:
  Problem(const std::vector<FreeParameter>& free_parameters, std::span<const StaticPoint> points,
          const StaticScales& scales)
      : free_parameters_(free_parameters),
        points_(points),
        scales_(scales),
        labels_(labels_of(points)) {
    for (const FreeParameter free_parameter : free_parameters) {
      parameters_.push_back(parameter_of(free_parameter, scales));
      priors_.push_back(prior_of(free_parameter, scales));
    }
    for (const RestLengthError& label : labels_) {
      if (!label.is_fitted()) continue;
      parameters_.push_back(parameter_of(label));
      priors_.push_back(Prior{0, rest_length_deviation(label.labelled)});
    }
  }

  std::size_t count() const { return points_.size() + parameters_.size() + (has_labels() ? 1 : 0); }
  const std::vector<Parameter>& parameters() const { return parameters_; }
  const std::optional<Prior>& prior(std::size_t i) const { return priors_[i]; }

  StaticSetting setting(std::span<const double> values) const {
    StaticSetting out = setting_of(scales_);
    for (std::size_t i = 0; i < free_parameters_.size(); ++i)
      value_of(out, free_parameters_[i]) = values[i];
    out.rest_lengths = labels_;
    std::size_t i = free_parameters_.size();
    for (RestLengthError& label : out.rest_lengths)
      if (label.is_fitted()) label.error = values[i++];
    return out;
  }

  // Returns the parameter values of a setting.
  std::vector<double> values(const StaticSetting& setting) const {
    std::vector<double> out;
    StaticSetting from = setting;
    for (const FreeParameter free_parameter : free_parameters_)
      out.push_back(value_of(from, free_parameter));
    for (const RestLengthError& r : labels_)
      if (r.is_fitted())
        out.push_back(std::clamp(rest_length_of(setting, r.labelled) - r.labelled, r.low, r.high));
    return out;
  }

  Residuals residuals(double scatter) const {
    return [this, scatter](std::span<const double> values, std::span<double> r) {
      fill(values, scatter, r, {});
      return std::all_of(r.begin(), r.end(), [](double x) { return std::isfinite(x); });
    };
  }

  // Returns the residuals with their derivatives.
  Slopes slopes(double scatter) const {
    return
        [this, scatter](std::span<const double> values, std::span<double> r, std::span<double> by) {
          std::ranges::fill(by, 0);
          fill(values, scatter, r, by);
          return true;
        };
  }

 private:
  bool has_labels() const { return parameters_.size() > free_parameters_.size(); }

  // Returns the sum of e_L/L_0.
  double in_common(std::span<const double> values) const {
    double sum = 0;
    std::size_t i = free_parameters_.size();
    for (const RestLengthError& label : labels_)
      if (label.is_fitted()) sum += values[i++] / label.labelled;
    return sum;
  }

  // Writes the residuals and, unless `by` is empty, their derivatives.
  void fill(std::span<const double> values, double scatter, std::span<double> r,
            std::span<double> by) const {
    fill_points(values, std::max(slack_below * scales_.full_scale, outlier * scatter), r, by);
    const std::size_t n = points_.size();
    for (std::size_t i = 0; i < priors_.size(); ++i) {
      r[n + i] = 0;
      if (!priors_[i]) continue;
      const Prior& prior = *priors_[i];
      r[n + i] = scatter * prior.away(values[i]) / prior.deviation;
      if (!by.empty()) by[i * r.size() + n + i] = scatter / prior.deviation_at(values[i]);
    }
    if (!has_labels()) return;
    r.back() = scatter * in_common(values) / common_deviation;
    std::size_t i = free_parameters_.size();
    for (const RestLengthError& label : labels_)
      if (label.is_fitted() && !by.empty())
        by[++i * r.size() - 1] = scatter / (label.labelled * common_deviation);
  }

  // Clips the law at zero for points below `slack`, which may be slack: a law that pushes there is
  // as good as one that ends.
  void fill_points(std::span<const double> values, double slack, std::span<double> r,
                   std::span<double> by) const {
    const StaticSetting at = setting(values);
    ForceSlopes slopes;
    std::size_t i = 0,
                own =
                    free_parameters_.size();  // parameter index of the error of the muscle's label
    for (const RestLengthError& label : labels_) {
      const MuscleLaw law(at, scales_, label.labelled);
      for (; i < points_.size() && points_[i].rest_length == label.labelled; ++i) {
        const StaticPoint& point = points_[i];
        const double length = fitted_length(at, point), f = law.force(length, point);
        const bool counts = point.force > slack || f > 0;
        r[i] = (counts ? f : 0.0) - point.force;
        if (by.empty() || !counts) continue;
        law.write_slopes(length, point, f, slopes);
        for (std::size_t k = 0; k < free_parameters_.size(); ++k)
          by[k * r.size() + i] = value_of(slopes.by_parameter, free_parameters_[k]);
        if (label.is_fitted()) by[own * r.size() + i] = slopes.by_label(point);
      }
      own += label.is_fitted() ? 1 : 0;
    }
  }

  const std::vector<FreeParameter>& free_parameters_;
  std::span<const StaticPoint> points_;
  const StaticScales& scales_;
  std::vector<RestLengthError> labels_;
  std::vector<Parameter> parameters_;  // free parameters, then fitted labels
  std::vector<std::optional<Prior>> priors_;
};

// Returns the mean variance of the force among the readings of an average.
double variance_within(std::span<const StaticPoint> points) {
  double sum = 0, readings = 0;
  for (const StaticPoint& p : points) {
    sum += p.weight * p.variance;
    readings += p.weight;
  }
  return readings > 0 ? sum / readings : 0;
}

// Writes the readings behind the points into the options, if they are averages. The residuals that
// follow, up to `count`, are priors in scatters of the averages: weights put them on the scale of
// the readings.
void put_readings(std::span<const StaticPoint> points, std::size_t count, double scatter,
                  SolverOptions& options) {
  if (std::ranges::all_of(points, [](const StaticPoint& p) { return p.weight == 1; })) return;
  for (const StaticPoint& p : points) {
    options.weights.push_back(p.weight);
    options.variances.push_back(p.variance);
  }
  const double of_readings = scatter * scatter + variance_within(points);
  options.weights.resize(count, of_readings / (scatter * scatter));
  options.variances.resize(count, of_readings);
}

// Returns the scatter of the residuals of taut points.
double scatter_of(std::span<const double> residuals, std::span<const StaticPoint> points,
                  const StaticScales& scales) {
  std::vector<double> taut;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].force > slack_below * scales.full_scale) taut.push_back(std::abs(residuals[i]));
  const double s = taut.empty() ? 0 : 1.4826 * median(taut);
  return std::clamp(s, least_scatter * scales.full_scale, most_scatter * scales.full_scale);
}

// Returns the start values: the likely ones, with braids of two angles.
std::vector<std::vector<double>> starts_of(std::span<const Parameter> parameters,
                                           const std::vector<FreeParameter>& free_parameters) {
  const std::vector<double> likely = starts_of(parameters);
  std::vector<std::vector<double>> out{likely};
  if (free_parameters.empty() || free_parameters[0] != FreeParameter::thread_length) return out;
  out.push_back(likely);
  out.back()[0] *= 1.2;
  out.back()[1] *= 0.8;
  return out;
}

// Keeps the growth of the friction's width below the limit of a file: where the optimum is beyond
// it, w_P is frozen at what w_F leaves to it, and the others are fitted again.
void limit_width(const Problem& problem, FitProblem& search, Solution& found) {
  constexpr double most = 0.999 * actuator::most_width_growth;  // also once its digits are rounded
  if (actuator::width_growth(problem.setting(found.values).actuator.hysteresis) <= most) return;
  const double share = found["width_per_tension"].value;
  std::ranges::find(search.parameters, "width_per_tension", &Parameter::name)->high = share;
  search.constraints = search.constraints.with_frozen("width_per_pressure", most - 2 * share, true);
  start_at(found.values, search);
  found = least_squares(search);
}

// Marks label errors that the data leave at their prior as not identifiable. If all are so, the
// data show only how the muscles differ. If one is at its bound, the others absorb a part of its
// error, and their intervals are unknown.
void judge_labels(StaticFit& fit) {
  const bool wrong = std::any_of(
      fit.solution.estimates.begin() + static_cast<std::ptrdiff_t>(fit.free_parameters.size()),
      fit.solution.estimates.end(), [](const Estimate& e) { return e.at_bound; });
  std::size_t i = fit.free_parameters.size();
  for (const RestLengthError& label : fit.setting.rest_lengths) {
    if (!label.is_fitted()) continue;
    Estimate& e = fit.solution.estimates[i++];
    const double before = rest_length_deviation(label.labelled);
    if (!e.at_bound && e.standard_error > prior_rules * before && std::abs(e.value) < before)
      e.identifiable = false;
    widen_by_common(fit.setting.rest_lengths, label, fit.solution.freedom, e);
    if (!wrong || e.at_bound) continue;
    e.remove_interval();
    e.identifiable = false;
  }
}

}  // namespace

const Estimate* rest_length_estimate(const StaticFit& fit, double labelled) {
  std::size_t i = fit.free_parameters.size();
  for (const RestLengthError& r : fit.setting.rest_lengths) {
    if (!r.is_fitted()) continue;
    if (r.labelled == labelled) return &fit.solution.estimates[i];
    ++i;
  }
  return nullptr;
}

double law_force(const actuator::Actuator& a, double length, const StaticPoint& point,
                 double atmosphere) {
  double p = point.pressure;
  if (actuator::has_hysteresis(a.hysteresis))
    p -= static_cast<int>(point.branch) * actuator::half_width(a, length, p, atmosphere);
  return actuator::clamped_tension(a, length, 0, p, atmosphere);
}

double predicted(const StaticSetting& setting, const StaticScales& scales,
                 const StaticPoint& point) {
  return std::max(0.0, law_force(scaled(setting, scales, point.rest_length),
                                 fitted_length(setting, point), point, scales.atmosphere));
}

std::vector<double> residuals_of(const StaticSetting& setting, const StaticScales& scales,
                                 std::span<const StaticPoint> points) {
  std::vector<double> out;
  for (const StaticPoint& point : points)
    out.push_back(predicted(setting, scales, point) - point.force);
  return out;
}

std::vector<double> residuals_of(const StaticFit& fit, std::span<const StaticPoint> points) {
  return residuals_of(fit.setting, fit.scales, points);
}

StaticFit fit_static(const std::vector<FreeParameter>& free_parameters,
                     std::span<const StaticPoint> points, const StaticScales& scales,
                     const StaticFit* start, double tolerance) {
  StaticFit out{
      .scales = scales, .free_parameters = free_parameters, .variance = variance_within(points)};
  Problem problem(out.free_parameters, points, scales);
  const std::size_t parameters = problem.parameters().size();
  const std::vector<int> settings = setting_groups({points.begin(), points.end()});
  const auto distinct = static_cast<std::size_t>(count_of(settings));
  if (distinct < parameters + 2)
    throw Refusal("data",
                  distinct < points.size()
                      ? fmt::format("{} points at {} settings", points.size(), distinct)
                      : fmt::format("{} points", points.size()),
                  fmt::format("at least {} for {} parameters", parameters + 2, parameters),
                  "more measurements, or a simpler model");
  FitProblem search{.count = problem.count(), .parameters = problem.parameters()};
  if (start) {
    out.scatter = start->scatter;
    search.constraints = start->constraints;
    for (Parameter& p : search.parameters)
      if (const auto same = std::ranges::find(start->parameters, p.name, &Parameter::name);
          same != start->parameters.end() && same->may_widen)
        p.low = same->low, p.high = same->high;
    start_at(problem.values(start->setting), search);
  } else {
    const double scatter = first_scatter * scales.full_scale;
    FitProblem rough = search;
    rough.residuals = problem.residuals(scatter);
    rough.options = {.tolerance = std::max(tolerance, 1e-9), .slopes = problem.slopes(scatter)};
    put_readings(points, problem.count(), scatter, rough.options);
    const std::vector<Solution> all =
        solutions_from(starts_of(search.parameters, free_parameters), rough);
    const Solution& first = best_of(all, rough.options);
    out.scatter = scatter_of(first.residuals, points, scales);
    start_at(first.values, search);
  }
  search.residuals = problem.residuals(out.scatter);
  search.options = {.outlier = outlier * out.scatter,
                    .correlated = true,
                    .tolerance = tolerance,
                    .slopes = problem.slopes(out.scatter)};
  put_readings(points, search.count, out.scatter, search.options);
  out.solution = start ? least_squares(search.residuals, search.count, search.parameters,
                                       search.constraints, search.options)
                       : least_squares_within(search);
  if (!start) limit_width(problem, search, out.solution);
  out.parameters = search.parameters;
  out.constraints = search.constraints;
  out.setting = problem.setting(out.solution.values);
  if (!start)
    widen(problem.slopes(out.scatter), problem.parameters(), problem.count(), settings,
          search.options.weights, out.scatter, outlier, out.solution);
  out.solution.residuals.resize(points.size());
  for (const double r : out.solution.residuals) out.outliers += std::abs(r) > outlier * out.scatter;

  for (std::size_t i = 0; i < free_parameters.size(); ++i) {
    Estimate& e = out.solution.estimates[i];
    const auto& prior = problem.prior(i);
    if (!prior || e.at_bound || !e.free) continue;
    if (e.standard_error < prior_rules * prior->deviation_at(e.value)) continue;
    e.identifiable = false;
    out.unknown.push_back(free_parameters[i]);
  }
  judge_labels(out);
  return out;
}

Refit refit_of(const StaticFit& fit, std::span<const StaticPoint> points) {
  struct Held {
    std::vector<FreeParameter> free_parameters;
    std::vector<StaticPoint> points;
    StaticScales scales;
    Problem problem{free_parameters, points, scales};
  };
  // Clang 14 cannot make an aggregate by std::make_shared.
  const std::shared_ptr<const Held> held(
      new Held{fit.free_parameters, std::vector(points.begin(), points.end()), fit.scales});
  FitProblem out{.count = held->problem.count(),
                 .parameters = fit.parameters,
                 .options = {.outlier = outlier * fit.scatter},
                 .constraints = fit.constraints,
                 .data = points.size()};
  put_readings(points, out.count, fit.scatter, out.options);
  out.residuals = [held, residuals = held->problem.residuals(fit.scatter)](
                      std::span<const double> p, std::span<double> r) { return residuals(p, r); };
  out.options.slopes = [held, slopes = held->problem.slopes(fit.scatter)](
                           std::span<const double> p, std::span<double> r, std::span<double> by) {
    return slopes(p, r, by);
  };
  return {std::move(out), fit.solution};
}

StaticFit fit_by_ratio(std::span<const StaticPoint> points, const StaticScales& scales) {
  StaticScales of_braid = scales;
  StaticSetting ideal = setting_of(scales);
  if (!scales.braid)
    ideal =
        fit_static({FreeParameter::thread_length, FreeParameter::turns}, points, scales).setting;
  of_braid.braid = ideal.actuator.braid;
  ideal.rest_lengths.clear();  // the thesis does not correct labels

  // Sums per nominal pressure, over points that pull.
  const std::vector<double> pressures = values_of(points, &StaticPoint::pressure);
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

  StaticFit out{.scales = of_braid,
                .free_parameters = {FreeParameter::eff_constant, FreeParameter::eff_linear,
                                    FreeParameter::eff_quadratic},
                .variance = variance_within(points)};
  std::vector<Parameter> parameters;
  for (const FreeParameter free_parameter : out.free_parameters)
    parameters.push_back(parameter_of(free_parameter, of_braid));
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
  for (const RestLengthError& r : labels_of(points))
    out.setting.rest_lengths.push_back({.labelled = r.labelled});
  for (std::size_t i = 0; i < out.free_parameters.size(); ++i)
    value_of(out.setting, out.free_parameters[i]) = out.solution.values[i];
  out.solution.residuals = residuals_of(out, points);
  out.scatter = scatter_of(out.solution.residuals, points, scales);
  return out;
}

}  // namespace sinew::identify
