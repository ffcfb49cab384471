#include "sinew/identify/sensor/sensor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "sinew/config/diagnostics.h"
#include "sinew/identify/contest/contest.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/data/quality.h"
#include "sinew/identify/sensor/points.h"
#include "sinew/units/quantity.h"

namespace sinew::identify {

namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t most_folds = 20;

// A model, with the powers of the known value that it has; proportional has no power 0.
struct Law {
  const char* name;
  const char* law;
  int first, last;
  std::size_t fewest_levels;
};
constexpr Law laws[] = {{"proportional", "V = s x", 1, 1, 2},
                        {"line", "V = V0 + s x", 0, 1, 2},
                        {"quadratic", "V = V0 + s x + c x^2", 0, 2, 4}};
constexpr const char* parameter_names[] = {"at_rest", "sensitivity", "curvature"};

double value_of(const Law& law, std::span<const double> p, double x) {
  double value = 0, power = law.first == 0 ? 1 : x;
  for (const double each : p) {
    value += each * power;
    power *= x;
  }
  return value;
}

// Returns the slope between the first and last point, as a start value.
double slope_of(std::span<const Point> points) {
  return (points.back().output - points.front().output) /
         (points.back().known - points.front().known);
}

// `points` are those of the calibration, followed by those of another one.
Candidate candidate_of(const Law& law, std::span<const Point> fitted, std::span<const Point> points,
                       double rest, const KindFacts& facts) {
  double reach = 0, span = 0;
  for (const Point& p : fitted) {
    reach = std::max(reach, std::abs(p.known - rest));
    span = std::max(span, std::abs(p.output - fitted.front().output));
  }
  // Deviations from a line are similar at similar values: residuals count as correlated.
  Candidate out{.model = law.name,
                .law = law.law,
                .source = "4.4, table 4-1",
                .options = {.correlated = true}};
  const std::string units[] = {"V", std::string(facts.sensitivity), std::string(facts.curvature)};
  for (int k = law.first; k <= law.last; ++k)
    out.parameters.push_back({.name = parameter_names[k],
                              .unit = units[k],
                              .start = k == 1 ? slope_of(fitted) : 0,
                              .scale = span / std::pow(reach, k)});
  out.predict = [&law, points, rest](std::span<const double> p, std::span<double> output) {
    for (std::size_t i = 0; i < points.size(); ++i)
      output[i] = value_of(law, p, points[i].known - rest);
    return true;
  };
  if (const std::size_t levels = level_count(fitted); levels < law.fewest_levels)
    out.refused = fmt::format("{} known values; it takes {}", levels, law.fewest_levels);
  return out;
}

// Predicts every known value from the others, or a twentieth of them at a time if there are many.
// Points of another calibration, after the first `fitted`, are all predicted.
Trial trial_of(std::span<const Point> points, std::size_t fitted) {
  Trial out;
  std::vector<int> fold;
  const std::span<const Point> own = points.first(fitted);
  const std::size_t folds = std::min(level_count(own), most_folds);
  for (std::size_t i = 0; i < points.size(); ++i) {
    out.measured.push_back(points[i].output);
    if (i < fitted) out.rows.push_back(i);
    if (i < fitted) fold.push_back(static_cast<int>(own[i].level % folds));
  }
  if (points.size() > fitted) {
    Split& split = out.splits.emplace_back(Split{out.rows});
    for (std::size_t i = fitted; i < points.size(); ++i) split.held_out.push_back(i);
  } else if (level_count(own) > 2) {
    out.splits = each_part_held_out(fold);
  }
  return out;
}

// Readings of one sensor without those at a limit.
struct Usable {
  std::vector<double> known, output;
  std::vector<int> lines;
  std::vector<Point> points;
  double step = no_value;
  std::vector<std::string> notes;
};

[[noreturn]] void refuse(const SensorData& data, const std::string& sensor, std::string found,
                         std::string expected, std::string try_this) {
  throw Refusal(fmt::format("{}: {}", data.file, sensor), found, expected, try_this);
}

// Levels with a reading at a limit are left out completely: a mean with clipped noise is biased.
std::set<std::size_t> rows_of_levels(std::span<const Point> points, const Ends& ends) {
  std::set<std::size_t> rows(ends.at_top.begin(), ends.at_top.end());
  rows.insert(ends.at_bottom.begin(), ends.at_bottom.end());
  std::set<std::size_t> levels, out;
  for (const Point& p : points)
    if (std::ranges::any_of(p.rows, [&](std::size_t r) { return rows.contains(r); }))
      levels.insert(p.level);
  for (const Point& p : points)
    if (levels.contains(p.level)) out.insert(p.rows.begin(), p.rows.end());
  return out;
}

std::string describe_ends(const Ends& ends) {
  const std::string top = fmt::format("{} at {:.4g} V", ends.at_top.size(), ends.top);
  const std::string bottom = fmt::format("{} at {:.4g} V", ends.at_bottom.size(), ends.bottom);
  return fmt::format("{}, the end of the sensor or its converter", ends.at_top.empty() ? bottom
                                                                   : ends.at_bottom.empty()
                                                                       ? top
                                                                       : top + " and " + bottom);
}

Usable without_ends(const SensorData& data, const SensorReadings& s, const CountScale& converter) {
  Usable all{.known = data.known, .output = s.volts, .lines = data.lines};
  all.points = points_of(all.known, all.output);
  all.step = s.counted ? converter.volts_per_count() : step_of(all.points, all.output);
  const Ends ends = ends_of(all.points, all.output, all.step, converter.top());
  const std::set<std::size_t> left_out = rows_of_levels(all.points, ends);
  if (left_out.empty()) return all;

  Usable kept{.step = all.step};
  for (std::size_t i = 0; i < all.known.size(); ++i) {
    if (left_out.contains(i)) continue;
    kept.known.push_back(all.known[i]);
    kept.output.push_back(all.output[i]);
    kept.lines.push_back(all.lines[i]);
  }
  kept.points = points_of(kept.known, kept.output);
  const std::string where =
      fmt::format("{} of {} readings at an end (first in line {}): {}", left_out.size(),
                  all.known.size(), all.lines[*left_out.begin()], describe_ends(ends));
  if (2 * kept.known.size() < all.known.size() || level_count(kept.points) < 2)
    refuse(data, s.name, where, "readings within its range, at two known values or more",
           "less load, less gain, or full_scale=VOLTS of your converter");
  kept.notes.push_back(fmt::format("{}: left out {}", s.name, where));
  return kept;
}

void refuse_poor(const SensorData& data, const SensorReadings& s, const Usable& u) {
  const KindFacts& facts = facts_of(data.kind);
  if (u.known.size() < 2)
    refuse(data, s.name, "one reading", "readings at two known values or more", "");
  if (level_count(u.points) < 2)
    refuse(data, s.name,
           fmt::format("one known value throughout, {}",
                       units::format_quantity(u.known.front(), facts.unit, facts.unit, 5)),
           "two or more: one does not determine both scale and offset",
           "another load, angle or pressure");
  const double low = smallest(u.output), high = largest(u.output);
  const double finest =
      std::isfinite(u.step) ? u.step : 1e-6 * std::max(std::abs(low), std::abs(high));
  if (high - low <= 2 * finest)
    refuse(data, s.name, fmt::format("{:.5g} V throughout", low),
           "an output that changes with what is measured",
           "the wiring and the sensor's supply, or sensors=NAMES without it");
}

// Throws Refusal if the output does not follow: more than half of its variation is unexplained.
void refuse_unrelated(const SensorData& data, const SensorReadings& s, const Fit& line,
                      std::span<const Point> points) {
  double mean = 0, variance = 0;
  for (const Point& p : points) mean += p.output / static_cast<double>(points.size());
  for (const Point& p : points) variance += std::pow(p.output - mean, 2);
  variance /= static_cast<double>(points.size());
  if (line.fit.rmse * line.fit.rmse <= 0.5 * variance) return;
  refuse(data, s.name, "an output that does not follow the known values",
         "a change with them that is larger than all else",
         "the columns: they may be swapped, or the sensor not connected");
}

void warn_of_outliers(const SensorData& data, const SensorReadings& s, const Usable& u,
                      const Law& law, const Fit& fit, double rest,
                      std::vector<std::string>& warnings) {
  std::vector<double> values, off;
  for (const Estimate& e : fit.parameters) values.push_back(e.value);
  for (std::size_t i = 0; i < u.known.size(); ++i)
    off.push_back(u.output[i] - value_of(law, values, u.known[i] - rest));
  const double finest = std::isfinite(u.step) ? u.step : 0;
  const double span = largest(u.output) - smallest(u.output);
  if (u.points.size() < 5) return;  // the fit would follow an outlier
  for (const std::size_t i : outliers(off, std::max(4 * finest, 0.02 * span)))
    warnings.push_back(
        fmt::format("{}:{}: {}: {:.4g} V is {:+.3g} V from the fit, far from the "
                    "others: a typing error?",
                    data.file, u.lines[i], s.name, u.output[i], off[i]));
}

double half_interval(const Estimate& e) { return 0.5 * (e.high - e.low); }

// Writes the result of the straight fit, which is the only law that robots have.
void describe(const Usable& u, const Fit& straight, SensorResult& r) {
  for (const Estimate& e : straight.parameters) {
    const bool slope = e.name == "sensitivity";
    (slope ? r.sensitivity : r.at_rest) = e.value;
    (slope ? r.sensitivity_uncertainty : r.at_rest_uncertainty) = half_interval(e);
  }
  r.linearity = straight.fit.max / r.span;
  r.step = u.step;
  r.noise = noise_of(u.points, u.output, u.step);
  const Hysteresis h = hysteresis_of(u.points, r.noise);
  r.hysteresis = h.largest / r.span;
  if (h.largest <= h.by_noise)
    r.report.notes.push_back(fmt::format("{}: the hysteresis is no more than noise makes", r.name));
}

// Returns the mean reading at every known value, separately for each direction; those after the
// first `fitted` are held out.
Rows rows_of(std::span<const Point> points, std::size_t fitted, const KindFacts& facts) {
  Rows out{.x = std::string(facts.word), .x_unit = std::string(facts.unit)};
  for (const Point& p : points) {
    out.held_out.push_back(out.at.size() >= fitted);
    out.at.push_back(p.known);
    out.measured.push_back(p.output);
    out.group.emplace_back(p.direction < 0 ? "from above" : "from below");
  }
  return out;
}

SensorResult calibrate(const SensorData& data, const SensorReadings& s, const CountScale& converter,
                       double rest, const SensorData* other, Calibration& out) {
  const KindFacts& facts = facts_of(data.kind);
  const Usable u = without_ends(data, s, converter);
  refuse_poor(data, s, u);
  SensorResult r{.name = s.name, .span = largest(u.output) - smallest(u.output)};
  r.report.set_subject("calibration of " + s.name, "output", "V", "its span");
  r.report.full_scale = r.span;
  r.report.notes = u.notes;

  r.report.not_shown = {"how the output changes with temperature and with time under load"};

  std::vector<Point> points = u.points;
  if (other) {
    const auto same = std::ranges::find(other->sensors, s.name, &SensorReadings::name);
    if (same == other->sensors.end())
      config::fail({other->file, 1, 1}, "sensor", "no column " + config::in_quotes(s.name),
                   "the sensors of " + data.file);
    const std::vector<Point> second = without_ends(*other, *same, converter).points;
    points.insert(points.end(), second.begin(), second.end());
  }
  r.report.rows = rows_of(points, u.points.size(), facts);
  const Trial trial = trial_of(points, u.points.size());
  std::vector<Candidate> candidates;
  for (const Law& law : laws)
    candidates.push_back(candidate_of(law, u.points, points, rest, facts));
  fit_candidates(candidates, trial, r.report);
  for (Fit& fit : r.report.fits)
    if (fit.refused.empty() && fit.fit.points <= fit.parameters.size())
      fit.notes.emplace_back("as many values as points: no error can be seen");
  refuse_unrelated(data, s, r.report.fits[1], u.points);
  if (r.report.fits[0].held_out)
    r.report.held_out_is = other ? other->file : "each known value from the others";

  // Differences below the error of the steps are not significant.
  const double steps = std::isfinite(u.step) ? u.step / std::sqrt(12.0) : 0;
  conclude(r.report, 0.1, std::max(1e-6, 100 * steps / r.span));
  const bool bent = r.report.chosen == 2;
  r.straight = bent ? 1 : r.report.chosen;
  describe(u, r.report.fits[r.straight], r);
  warn_of_outliers(data, s, u, laws[r.report.chosen], r.report.best(), rest, out.warnings);
  if (bent)
    out.warnings.push_back(fmt::format(
        "{}: the output is bent; a robot's sensor is a straight line, which is up to {:.2g} % of "
        "the span off",
        s.name, 100 * r.linearity));
  return r;
}

}  // namespace

Calibration identify_sensors(const SensorData& data, const CountScale& converter, double rest,
                             const SensorData* other) {
  Calibration out{.kind = data.kind, .file = data.file, .notes = data.notes};
  for (const SensorReadings& s : data.sensors)
    out.sensors.push_back(calibrate(data, s, converter, rest, other, out));
  for (const SensorResult& r : out.sensors)
    out.average += r.sensitivity / static_cast<double>(out.sensors.size());
  for (SensorResult& r : out.sensors) r.deviation = out.average / r.sensitivity - 1;
  return out;
}

}  // namespace sinew::identify
