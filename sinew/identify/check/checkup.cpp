#include "sinew/identify/check/checkup.h"

#include "sinew/identify/fit/fit.h"
#include "sinew/json/json.h"

namespace sinew::identify {

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
    out.determined.refused = "a check is red: what the data say would be wrong";
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
