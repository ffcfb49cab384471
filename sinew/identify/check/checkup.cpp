#include "sinew/identify/check/checkup.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/identify/actuator/static_groups.h"
#include "sinew/identify/actuator/static_law_fitter.h"
#include "sinew/identify/contest/fit.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/json/json.h"

namespace sinew::identify {

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
