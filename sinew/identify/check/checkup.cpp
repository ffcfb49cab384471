#include "sinew/identify/check/checkup.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "sinew/identify/actuator/static_groups.h"
#include "sinew/identify/actuator/static_law_fitter.h"
#include "sinew/identify/actuator/static_settled.h"
#include "sinew/identify/contest/fit.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/data/quality.h"
#include "sinew/identify/data/series.h"
#include "sinew/json/json.h"
#include "sinew/units/constants.h"

namespace sinew::identify {

namespace {

RecognisedFile file_of(const Measured& m) {
  RecognisedFile out{.file = m.file, .rows = m.rows(), .is_recording = m.has("time")};
  for (const Column& c : m.columns) {
    if (c.name == "branch") {  // words, not numbers
      out.columns.push_back({c.name, smallest(c.values) < 0 ? "vent" : "fill",
                             largest(c.values) > 0 ? "fill" : "vent"});
      continue;
    }
    out.columns.push_back({c.name, in_unit_of_file(m, c.name, smallest(c.values), 4),
                           in_unit_of_file(m, c.name, largest(c.values), 4)});
  }
  if (!out.is_recording || !m.has("pressure") || m.rows() == 0) return out;
  const Settled settled = settled_samples(m["time"], m["pressure"]);
  out.settled = 1 - static_cast<double>(settled.moving()) / static_cast<double>(m.rows());
  return out;
}

std::string branches_of(const std::vector<StaticPoint>& points) {
  std::string out;
  for (const auto& [branch, name] : {std::pair{Branch::fill, "fill"}, {Branch::vent, "vent"}})
    if (has_branch(points, branch)) out += (out.empty() ? "" : ", ") + std::string(name);
  return out;
}

RecognisedMount mount_of(const std::vector<StaticPoint>& points) {
  RecognisedMount out{.rest_length = points[0].rest_length,
                      .length = median(values_of(points, &StaticPoint::length)),
                      .branches = branches_of(points),
                      .pressures = count_of(pressure_groups(points)),
                      .lowest = points[0].pressure,
                      .highest = points[0].pressure,
                      .strongest = points[0].force};
  for (const StaticPoint& p : points) {
    ++(p.fitted ? out.points : out.held_out);
    out.lowest = std::min(out.lowest, p.pressure);
    out.highest = std::max(out.highest, p.pressure);
    out.strongest = std::max(out.strongest, p.force);
  }
  return out;
}

}  // namespace

Recognised recognise(const CheckInput& input) {
  Recognised out;
  for (const CheckedTable& t : input.tables) out.files.push_back(file_of(t.table));
  const std::vector<StaticPoint>& points = input.data.points;
  if (points.empty()) return out;
  const std::vector<int> group = length_groups(points);  // sorted by muscle, then by length
  for (int g = 0; g <= *std::ranges::max_element(group); ++g) {
    std::vector<StaticPoint> own;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (group[i] == g) own.push_back(points[i]);
    if (!own.empty()) out.mounts.push_back(mount_of(own));
  }
  out.noise = force_noise(input);
  return out;
}

// --- noise of the force ---

namespace {

constexpr std::size_t rest_window = 25;  // samples of a straight line
constexpr double same_length = 2e-3;     // share of the longest: readings of one mount
constexpr double same_pressure = 0.01;   // share of the highest: readings of one step

// Sum of squares of residuals, with its degrees of freedom.
struct Squares {
  double sum = 0, freedom = 0;
  std::size_t readings = 0;
};

// Adds the residuals about a straight line over x, or about the mean if all x are equal.
void add_about_line(std::span<const double> x, std::span<const double> y, Squares& out) {
  const auto n = static_cast<double>(y.size());
  const StraightLine line = line_through(x, y);
  const bool leans = line.xx > 1e-12 * line.x * line.x && n > 2;
  const double slope = leans ? line.slope() : 0;
  for (std::size_t i = 0; i < y.size(); ++i)
    out.sum += std::pow(y[i] - line.y - slope * (x[i] - line.x), 2);
  out.freedom += n - (leans ? 2 : 1);
  out.readings += y.size();
}

// Adds samples at rest, in windows. A window that scatters far more than most is left out: the
// muscle may have reached an end of its travel there.
void add_rests(const Measured& m, Squares& out) {
  constexpr double far_more = 3;  // times the median scatter
  const bool weighs = m.has("load");
  const std::vector<double>& force = m[weighs ? "load" : "force"];
  const std::vector<bool> rests = settled_samples(m["time"], m["pressure"]).sample;
  std::vector<Squares> windows;
  std::vector<double> scatter;
  for (std::size_t i = 0; i < force.size();) {
    std::size_t end = i;
    while (end < force.size() && rests[end] && end - i < rest_window) ++end;
    if (end - i >= 5) {
      add_about_line(std::span(m["time"]).subspan(i, end - i), std::span(force).subspan(i, end - i),
                     windows.emplace_back());
      scatter.push_back(std::sqrt(windows.back().sum / windows.back().freedom));
    }
    i = std::max(end, i + 1);
  }
  const double unit = weighs ? units::standard_gravity : 1, most = far_more * median(scatter);
  for (std::size_t k = 0; k < windows.size(); ++k) {
    if (most > 0 && scatter[k] > most) continue;
    out.sum += windows[k].sum * unit * unit;
    out.freedom += windows[k].freedom;
    out.readings += windows[k].readings;
  }
}

// Adds readings of one muscle, length and branch, sorted by pressure, in groups of nearly equal
// pressure, each about its line.
void add_repeated(const std::vector<StaticPoint>& sorted, double near, Squares& out) {
  for (std::size_t i = 0; i < sorted.size();) {
    std::size_t end = i;
    std::vector<double> pressure, force;
    for (; end < sorted.size() && sorted[end].pressure - sorted[i].pressure <= near; ++end) {
      pressure.push_back(sorted[end].pressure);
      force.push_back(sorted[end].force);
    }
    if (force.size() >= 2) add_about_line(pressure, force, out);
    i = end;
  }
}

Squares of_tables(const std::vector<StaticPoint>& points) {
  const double longest = std::max(0.0, largest(values_of(points, &StaticPoint::length))),
               top = std::max(0.0, largest(values_of(points, &StaticPoint::pressure)));
  std::vector<StaticPoint> sorted = points;
  sort_points(sorted);
  Squares out;
  for (std::size_t i = 0; i < sorted.size();) {
    std::size_t end = i;
    while (end < sorted.size() && sorted[end].rest_length == sorted[i].rest_length &&
           sorted[end].branch == sorted[i].branch &&
           sorted[end].length - sorted[i].length <= same_length * longest)
      ++end;
    std::vector<StaticPoint> own(sorted.begin() + static_cast<std::ptrdiff_t>(i),
                                 sorted.begin() + static_cast<std::ptrdiff_t>(end));
    std::ranges::stable_sort(own, {}, &StaticPoint::pressure);
    add_repeated(own, same_pressure * top, out);
    i = end;
  }
  return out;
}

}  // namespace

ForceNoise force_noise(const CheckInput& input) {
  Squares recorded;
  double strongest = 0;
  for (const StaticPoint& p : input.data.points) strongest = std::max(strongest, p.force);
  for (const CheckedTable& t : input.tables) {
    const Measured& m = t.table;
    if (m.has("time") && m.has("pressure") && m.has("force") != m.has("load"))
      add_rests(m, recorded);
  }
  const bool records = recorded.freedom > 0;
  const Squares squares = records ? recorded : of_tables(input.data.points);
  ForceNoise out;
  // Readings that differ only in the last digits of a number are copies.
  if (!(squares.freedom >= 3) || !(strongest > 0) ||
      !(std::sqrt(squares.sum / squares.freedom) > 1e-9 * strongest))
    return out;
  out.deviation = std::sqrt(squares.sum / squares.freedom);
  out.share = out.deviation / strongest;
  out.readings = squares.readings;
  out.from = records ? "settled samples" : "repeated readings";
  return out;
}

// --- parameters that a fit could determine ---

namespace {

constexpr double known_share = 0.5;  // share of the value; a wider interval gives its order at best

// Returns the measurement that would determine a parameter.
std::string_view measurement_for(std::string_view name) {
  constexpr std::pair<std::string_view, std::string_view> all[] = {
      {"thread_length",
       "mounts over a longer range, down to 80 % of the rest length; or the mesh's own geometry, "
       "by "
       "`sinew identify geometry`"},
      {"turns", "more pressures at the longest mounts; or the mesh's own geometry"},
      {"effectiveness_c0", "more pressures at each mount"},
      {"effectiveness_c1", "pressures over a wider range, up to the highest that is allowed"},
      {"threshold", "pressures in small steps from 20 to 150 kPa at the longest mount"},
      {"bladder_stiffness", "mounts over a longer range, down to 80 % of the rest length"},
      {"saturating_tension", "two or three mounts within 5 % of the rest length"},
      {"saturation_length", "mounts 1, 2 and 4 % shorter than the rest length"},
      {"half_width", "the same pressures on the way up and on the way down"},
      {"end_loss", "a muscle of the same make with another rest length"},
  };
  for (const auto& [which, measurement] : all)
    if (which == name) return measurement;
  return "more mounts and more pressures";
}

// Returns the richest law; of two similar ones, the one that holds for any muscle of a make.
const StaticModel& richest_law() {
  for (const StaticModel& m : static_models())
    if (m.name == "saturating-effectiveness") return m;
  return static_models().back();
}

Determined one_determined(const Estimate& e, bool leans) {
  Determined out{.name = e.name,
                 .unit = e.unit,
                 .value = e.value,
                 .half_width = e.at_bound ? unbounded : 0.5 * (e.high - e.low)};
  const double share = out.half_width / std::abs(e.value);
  if (e.at_bound) {
    out.by = Determination::at_bound;
    out.words = "at the end of its range: the data show no such effect";
    return out;
  }
  if (leans) {
    out.by = Determination::by_priors;
    out.words = "from other muscles: the data hardly show it";
  } else if (std::isfinite(share) && share <= known_share) {
    out.by = Determination::by_data;
    out.words = fmt::format("to +-{:.2g} %", 100 * share);
    return out;
  } else if (std::isfinite(share) && share < 1) {
    out.words = fmt::format("its size at best, to +-{:.2g} %", 100 * share);
  } else {
    out.words = "no: zero would do as well";
  }
  out.advice = measurement_for(e.name);
  return out;
}

// Returns the result for a parameter on which no measurement depends.
Determined without_measurement(const char* name, const char* unit, const char* words) {
  return {.name = name,
          .unit = unit,
          .half_width = unbounded,
          .words = words,
          .advice = std::string(measurement_for(name))};
}

std::vector<StaticPoint> fitted_points(const CheckInput& input) {
  std::vector<StaticPoint> out;
  double longest = 0;
  for (const StaticPoint& p : input.data.points) {
    longest = std::max(longest, p.length);
    if (p.fitted) out.push_back(p);
  }
  for (StaticPoint& p : out)
    if (!(p.rest_length > 0)) p.rest_length = longest;
  sort_points(out);
  return out;
}

void add_parameters(const StaticFit& fit, DeterminedLaw& out) {
  bool branches = false;
  for (std::size_t i = 0; i < fit.free_parameters.size(); ++i) {
    const bool leans = std::ranges::find(fit.unknown, fit.free_parameters[i]) != fit.unknown.end();
    out.parameters.push_back(one_determined(fit.solution.estimates[i], leans));
    branches = branches || fit.free_parameters[i] == FreeParameter::half_width;
  }
  if (!branches)
    out.parameters.push_back(without_measurement(
        "half_width", "Pa diff", "no: there is one branch, or the branch is not given"));
}

}  // namespace

DeterminedLaw determine(const CheckInput& input) {
  const StaticModel& model = richest_law();
  DeterminedLaw out{.model = std::string(model.name), .law = std::string(model.law)};
  const std::vector<StaticPoint> points = fitted_points(input);
  try {
    if (points.empty()) throw Refusal("data", "no points", "some", "");
    const StaticScales scales = scales_of(points, input.atmosphere, input.braid);
    add_parameters(StaticLawFitter(model, scales, points).fit(points), out);
  } catch (const Refusal& refusal) {
    out.refused = refusal.what();
  }
  return out;
}

std::string_view word(Determination by) {
  switch (by) {
    case Determination::by_data:
      return "data";
    case Determination::by_priors:
      return "priors";
    case Determination::at_bound:
      return "bound";
    case Determination::undetermined:
      break;
  }
  return "nothing";
}

namespace {

Json json_of_checks(const std::vector<Check>& checks) {
  Json out = Json::array();
  for (const Check& c : checks) {
    Json one{{"name", c.name}, {"light", word(c.light)}, {"evidence", c.evidence}};
    if (!c.advice.empty()) one["advice"] = c.advice;
    out.push_back(one);
  }
  return out;
}

Json json_of_files(const std::vector<RecognisedFile>& files) {
  Json out = Json::array();
  for (const RecognisedFile& f : files) {
    Json one{{"file", f.file}, {"rows", f.rows}, {"recording", f.is_recording}};
    if (f.is_recording) one["settled_share"] = f.settled;
    one["columns"] = Json::array();
    for (const RecognisedColumn& c : f.columns)
      one["columns"].push_back({{"name", c.name}, {"lowest", c.lowest}, {"highest", c.highest}});
    out.push_back(one);
  }
  return out;
}

Json json_of_mounts(const std::vector<RecognisedMount>& mounts) {
  Json out = Json::array();
  for (const RecognisedMount& m : mounts) {
    Json one;
    if (m.rest_length > 0) one["rest_length_m"] = m.rest_length;
    one["length_m"] = m.length;
    if (!m.branches.empty()) one["branches"] = m.branches;
    one["points"] = m.points;
    if (m.held_out > 0) one["held_out"] = m.held_out;
    one["pressures"] = m.pressures;
    one["lowest_gauge_pressure_Pa"] = m.lowest;
    one["highest_gauge_pressure_Pa"] = m.highest;
    one["strongest_N"] = m.strongest;
    out.push_back(one);
  }
  return out;
}

Json json_of_noise(const ForceNoise& noise) {
  return {{"force_N", noise.deviation},
          {"share_of_largest_force", noise.share},
          {"readings", noise.readings},
          {"from", noise.from}};
}

Json json_of_law(const DeterminedLaw& law) {
  Json out{{"model", law.model}, {"law", law.law}};
  if (!law.refused.empty()) out["refused"] = law.refused;
  out["parameters"] = Json::array();
  for (const Determined& d : law.parameters) {
    Json one{{"name", d.name}, {"unit", d.unit}, {"determined_by", word(d.by)}};
    if (d.value != 0) one["value"] = d.value;
    one["half_width_95"] = finite_or_null(d.half_width);
    one["words"] = d.words;
    if (!d.advice.empty()) one["advice"] = d.advice;
    out["parameters"].push_back(one);
  }
  return out;
}

}  // namespace

Checkup check_up(const CheckInput& input) {
  Checkup out{.checks = check_static(input), .recognised = recognise(input)};
  if (has_red(out.checks))
    out.determined.refused = "a check is red: what the data show would be wrong";
  else
    out.determined = determine(input);
  return out;
}

Json to_json(const Checkup& checkup) {
  Json out{{"format", "sinew.check/1"}, {"red", has_red(checkup.checks)}};
  out["recognised"] = {{"files", json_of_files(checkup.recognised.files)},
                       {"mounts", json_of_mounts(checkup.recognised.mounts)}};
  if (checkup.recognised.noise.readings > 0) out["noise"] = json_of_noise(checkup.recognised.noise);
  out["determined"] = json_of_law(checkup.determined);
  out["checks"] = json_of_checks(checkup.checks);
  return out;
}

}  // namespace sinew::identify
