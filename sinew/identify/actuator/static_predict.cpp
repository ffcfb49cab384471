#include "sinew/identify/actuator/static_predict.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sinew/actuator/prediction.h"
#include "sinew/actuator/tension.h"
#include "sinew/identify/actuator/static_labels.h"
#include "sinew/identify/contest/refusal.h"

namespace sinew::identify {

namespace {

using Intervals = actuator::Prediction;

constexpr double a_fifth = 0.2;           // share of the range, "beyond" of prediction.h
constexpr double beyond_share = 0.3;      // share of the error between lengths beyond the shortest
constexpr double growth_share = 1.0 / 3;  // share of the growth of sigma_F in that error
constexpr int nodes = 5;                  // number of pressures
constexpr std::size_t most_lengths = 9;

const StaticMuscle* fitted(const StaticResult& result, double rest_length) {
  for (const StaticMuscle& m : result.muscles)
    if (std::abs(m.rest_length - rest_length) < same_label) return &m;
  return nullptr;
}

bool within(double x, double low, double high) {
  const double slip = 1e-6 * std::max(std::abs(low), std::abs(high));
  return x >= low - slip && x <= high + slip;
}

// sigma_F at a point and, between two lengths, its growth from them: the root of the difference of
// the squares  [N].
struct Width {
  double sigma = 0, growth = 0;
};

Width width_of(const StaticResult& result, const std::vector<double>& lengths,
               const StaticPoint& point) {
  const auto [below, above] = actuator::neighbours_of(lengths, point.length);
  std::vector<StaticPoint> three(3, point);
  const bool is_between = std::isfinite(above - below) && above > below;
  if (is_between) three[1].length = below, three[2].length = above;
  const std::vector<double> w = widths(result.fit, three);
  const double part = is_between ? (point.length - below) / (above - below) : 0;
  const double square = (1 - part) * w[1] * w[1] + part * w[2] * w[2];
  return {std::sqrt(square), std::sqrt(std::max(0.0, w[0] * w[0] - square))};
}

// Returns the root mean squares of both half-widths.
std::array<double, 2> mean_widths(const StaticResult& result,
                                  const std::vector<StaticPoint>& points) {
  std::array<double, 2> sum{};
  for (const StaticPoint& p : points) {
    const StaticForce f = predict(result, p);
    sum[0] += f.half_68 * f.half_68 / static_cast<double>(points.size());
    sum[1] += f.half_95 * f.half_95 / static_cast<double>(points.size());
  }
  return {std::sqrt(sum[0]), std::sqrt(sum[1])};
}

// Writes half-widths, no narrower than `least`; 0 if unknown.
void write_widths(const std::array<double, 2>& widths, const std::array<double, 2>& least,
                  double& half_68, double& half_95) {
  const bool known = std::isfinite(widths[1]) && widths[1] > 0;
  half_68 = known ? std::max(widths[0], least[0]) : 0;
  half_95 = known ? std::max(widths[1], least[1]) : 0;
}

// Returns the end lengths and a selection of the others: a sweep has hundreds.
std::vector<double> some_of(const std::vector<double>& lengths) {
  std::vector<double> out;
  const std::size_t last = lengths.size() - 1, count = std::min(last, most_lengths - 1);
  for (std::size_t i = 0; i <= count; ++i)
    out.push_back(lengths[count > 0 ? (i * last + count / 2) / count : 0]);
  return out;
}

// Points at which the half-widths in a muscle's file are evaluated.
struct IntervalPoints {
  std::vector<StaticPoint> inside, between, beyond, above;
};

IntervalPoints interval_points_of(const StaticMuscle& m) {
  IntervalPoints out;
  const double range = m.lengths.back() - m.lengths.front(), pressure = m.highest - m.lowest;
  const double gap = actuator::widest_gap(m.lengths);
  const auto add = [&](std::vector<StaticPoint>& to, double length, double up) {
    to.push_back(
        {.length = length, .pressure = m.lowest + up * pressure, .rest_length = m.rest_length});
  };
  for (const double length : some_of(m.lengths))
    if (pressure > 0) add(out.above, length, 1 + a_fifth);
  for (int k = 0; k < nodes; ++k) {
    const double up = k / (nodes - 1.0);
    for (const double length : some_of(m.lengths)) add(out.inside, length, up);
    for (std::size_t i = 1; i < m.lengths.size(); ++i)
      if (m.lengths[i] - m.lengths[i - 1] > 0.999 * gap)
        add(out.between, 0.5 * (m.lengths[i] + m.lengths[i - 1]), up);
    if (!(range > 0)) continue;
    add(out.beyond, m.lengths.front() - a_fifth * range, up);
  }
  return out;
}

}  // namespace

StaticMuscle muscle_of(const StaticResult& result, double rest_length) {
  if (const StaticMuscle* m = fitted(result, rest_length)) return *m;
  StaticMuscle out = result.muscles.front();
  const double ratio = rest_length / out.rest_length;
  out.actuator = scaled(result.fit.setting, result.fit.scales, rest_length);
  out.rest_length = out.file_length = rest_length;
  out.half_68 = out.half_95 = 0;
  for (double& length : out.lengths) length *= ratio;
  return out;
}

StaticForce predict(const StaticResult& result, const StaticPoint& point) {
  const StaticSpread& spread = result.spread;
  const StaticMuscle muscle = muscle_of(result, point.rest_length);
  std::vector<StaticPoint> one{point};
  one[0].rest_length = muscle.rest_length;
  StaticForce out{.force = predicted(result.fit.setting, result.fit.scales, one[0])};
  const double longest = muscle.lengths.back();
  const bool is_between = within(point.length, muscle.lengths.front(), longest);
  const bool inside = is_between && within(point.pressure, muscle.lowest, muscle.highest);
  Quantiles q = inside ? spread.inside : spread.beyond;
  if (point.length > (1 + actuator::same_length) * longest) q = {};
  const bool is_fitted = fitted(result, point.rest_length) != nullptr;
  const Width width =
      is_fitted ? width_of(result, muscle.lengths, one[0]) : Width{widths(result.fit, one)[0]};
  out.half_68 = q.q68 * width.sigma;
  out.half_95 = q.q95 * width.sigma;
  if (!is_fitted) {
    const StaticPoint top{
        .length = longest, .pressure = muscle.highest, .rest_length = muscle.rest_length};
    const double scale =
        std::hypot(predicted(result.fit.setting, result.fit.scales, top), by_force * out.force);
    const auto of_muscle = [scale](double share) {
      return share > 0 ? share * scale : std::numeric_limits<double>::infinity();
    };
    out.half_68 = std::max(out.half_68, of_muscle(spread.other_share_68));
    out.half_95 = std::max(out.half_95, of_muscle(spread.other_share_95));
    out.kind = PredictionKind::other_muscle;
    return out;
  }
  out.kind = inside ? PredictionKind::inside : PredictionKind::beyond;
  const double form =
      (is_between ? 1 : beyond_share) * spread.between_68 *
      std::sqrt(actuator::harmonic_distance(muscle.lengths, point.length) / muscle.rest_length);
  const double of_form = std::max(form, growth_share * width.growth);
  out.half_68 = std::hypot(out.half_68, of_form);
  out.half_95 = std::hypot(out.half_95, form_95 * of_form);
  return out;
}

actuator::Prediction prediction_of(const StaticResult& result, const StaticMuscle& m) {
  if (!fitted(result, m.rest_length)) {
    actuator::Actuator reference = result.muscles.front().actuator;
    reference.prediction = prediction_of(result, result.muscles.front());
    Intervals out =
        with_rest_length(reference, m.rest_length, result.fit.scales.atmosphere).prediction;
    out.lengths = m.lengths;
    return out;
  }
  const IntervalPoints places = interval_points_of(m);
  actuator::Prediction out{
      .rest_length = m.file_length, .lengths = m.lengths, .lowest = m.lowest, .highest = m.highest};
  // The errors on its own rows are a lower limit of those on other rows.
  write_widths(mean_widths(result, places.inside), {m.half_68, m.half_95}, out.inside_68,
               out.inside_95);
  const std::array<double, 2> least{out.inside_68, out.inside_95};
  write_widths(mean_widths(result, places.between), least, out.between_68, out.between_95);
  write_widths(mean_widths(result, places.beyond), least, out.beyond_68, out.beyond_95);
  write_widths(mean_widths(result, places.above), least, out.above_68, out.above_95);
  out.other_68 = result.spread.other_share_68;
  out.other_95 = result.spread.other_share_95;
  out.other_reach = result.spread.other_reach;
  return out;
}

ReadingFactor reading_factor(const actuator::Actuator& a, const ForceReading& r, double atmosphere,
                             double weight) {
  constexpr double strength = 0.02, form = 0.01, left_out = 3;
  const double force = actuator::clamped_tension(a, r.length, 0, r.gauge_pressure, atmosphere);
  const double ratio = force > 0 ? r.force / force : 0;
  if (!(ratio > 0.5 && ratio < 2))
    throw Refusal("reading", fmt::format("{:.4g} N", r.force),
                  fmt::format("a force near the {:.4g} N that the law has at {:.4g} mm and {:.4g} "
                              "kPa gauge",
                              std::max(force, 0.0), 1e3 * r.length, 1e-3 * r.gauge_pressure),
                  "a reading well within the range of the muscle, in these units");
  const actuator::Prediction& p = a.prediction;
  const double most =
      actuator::clamped_tension(a, p.lengths.back(), 0, p.highest, atmosphere) / force;
  ReadingFactor out;
  out.law = 1 + (ratio - 1) / (1 + std::pow(form * most / strength, 2));
  const double left = 1 - out.law / ratio;
  if (p.other_68 > 0) {
    const double t = p.other_68 * std::hypot(most, weight);
    out.share = std::sqrt((left_out + std::pow(left / t, 2)) / (left_out + 1));
  }
  return out;
}

actuator::Actuator scale_force(actuator::Actuator a, double factor) {
  // effectiveness.scale is left: it is the share of the ends, used to scale a file to other
  // lengths.
  for (double* spring :
       {&a.effectiveness.c0, &a.effectiveness.c1, &a.effectiveness.c2, &a.bladder.stiffness,
        &a.bladder.quadratic, &a.bladder.cubic, &a.bladder.saturating_tension, &a.toe.tension})
    *spring *= factor;
  a.series.compliance /= factor;
  return a;
}

actuator::Actuator with_rest_length(const actuator::Actuator& actuator, double rest_length,
                                    double atmosphere, double share_factor, double weight) {
  const double from = actuator.prediction.rest_length;
  if (!(from > 0) || actuator.prediction.lengths.empty())
    throw Refusal("actuator", "no prediction.rest_length", "one, as `identify static` writes it",
                  "a file of `identify static`, or prediction.rest_length in it");
  actuator::Actuator a = scaled_actuator(actuator, from, rest_length);
  const double ratio = rest_length / from;
  const actuator::Prediction old = actuator.prediction;
  actuator::Prediction& p = a.prediction;
  p.rest_length = rest_length;
  for (double& length : p.lengths) length *= ratio;
  const double most = actuator::tension(a, p.lengths.back(), 0, p.highest, atmosphere);
  const double away = std::abs(std::log(ratio));
  const double stretch =
      share_factor * (old.other_reach > 0 ? std::max(1.0, away / old.other_reach) : 1.0);
  const auto widen = [&](double share, double Intervals::*inside, double Intervals::*between,
                         double Intervals::*beyond, double Intervals::*above,
                         double Intervals::*per_force) {
    const double known = share > 0 ? 1 : 0;
    p.*inside = known * std::max(share * stretch * most, old.*inside);
    p.*between = known * std::max(p.*inside, old.*between);
    p.*per_force = known * weight * share * stretch;
    // Errors outside the measured range are added as squares.
    for (double Intervals::*outside : {beyond, above}) {
      const double more = std::pow(old.*outside, 2) - std::pow(old.*inside, 2);
      p.*outside =
          old.*outside > 0 ? known * std::sqrt(std::pow(p.*inside, 2) + std::max(more, 0.0)) : 0;
    }
  };
  widen(old.other_68, &Intervals::inside_68, &Intervals::between_68, &Intervals::beyond_68,
        &Intervals::above_68, &Intervals::per_force_68);
  widen(old.other_95, &Intervals::inside_95, &Intervals::between_95, &Intervals::beyond_95,
        &Intervals::above_95, &Intervals::per_force_95);
  return a;
}

}  // namespace sinew::identify
