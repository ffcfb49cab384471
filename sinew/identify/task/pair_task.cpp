#include "sinew/identify/task/methods.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "sinew/config/diagnostics.h"
#include "sinew/config/node.h"
#include "sinew/config/quantity.h"
#include "sinew/config/setting.h"
#include "sinew/config/write/writer.h"
#include "sinew/identify/contest/fit.h"
#include "sinew/identify/contest/provenance.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/data/averaged.h"
#include "sinew/identify/pair/pair.h"
#include "sinew/identify/task/tables.h"
#include "sinew/json/json.h"

namespace sinew::identify {

namespace {

// --- the identified pair as JSON and as a part of a robot ---

// Losses of a joint in a robot's file.
struct JointLosses {
  std::string name;
  double damping = std::numeric_limits<double>::quiet_NaN(), dry_friction = damping;
};

// Returns stiffness, sensors and trapped air, in SI with the unit in the key.
Json describe(const PairResult& found) {
  const bool rotary = found.rotary;
  const std::string per = rotary ? "_Nm_per_rad" : "_N_per_m", effort = rotary ? "_Nm" : "_N";
  Json out;
  out["stiffness" + per] = found.stiffness.value;
  out["stiffness_uncertainty" + per] = found.stiffness.uncertainty;
  out["stiffness_of_air" + per] = finite_or_null(found.stiffness.air);
  for (const PairSensorsOf& s : found.sensors)
    out["recordings"].push_back({{"file", s.file},
                                 {"rig", s.rig},
                                 {"bias" + effort, s.sensors.bias},
                                 {"gain", s.sensors.gain},
                                 {"delay_s", s.sensors.delay}});
  if (!found.air) return out;
  Json air{
      {"change_per_position_Pa_per_" + std::string(rotary ? "rad" : "m"), found.air->per_position}};
  for (std::size_t m = 0; m < found.air->slope.size(); ++m)
    air["muscles"].push_back(
        {{"pressure_Pa_abs", found.air->pressure[m]},
         {rotary ? "relative_change_1_per_rad" : "relative_change_1_per_m", found.air->slope[m]},
         {"falls", static_cast<bool>(found.air->falls[m])}});
  air["report"] = to_json(found.air->report);
  out["air"] = air;
  return out;
}

// Returns `robot` with damping and dry friction of the named joint, whose pair was measured. A
// loss that the law does not have is left out. Throws Refusal for a slide, which is not a joint.
std::string pair_file(const PairResult& found, const std::string& joint, const std::string& source,
                      config::Node robot) {
  if (!found.rotary)
    throw Refusal("out", "a slide",
                  "torque and angle of a joint: in a robot's file muscles move joints, and these "
                  "alone have dry_friction and damping. Of a slide N/m and N s/m have no place "
                  "there, as long as no lever turns them into N m",
                  "no file: the report and its JSON have all values");
  Provenance provenance;
  std::vector<JointLosses> joints{{.name = joint}};
  const std::string path = "joint." + joint + ".";
  for (const Estimate& e : found.report.best().parameters) {
    if (e.name == "viscous") joints[0].damping = e.value;
    if (e.name == "friction") joints[0].dry_friction = e.value;
    if (e.name == "viscous") provenance.fitted(path + "damping", e, source);
    if (e.name == "friction")
      provenance.fitted(path + "dry_friction", e, source + ", with that of the muscles");
  }
  config::Writer writer(&provenance.origins());
  writer.each({.name = "joint"}, joints, [](auto& v, JointLosses& j) {
    v.number({.name = "dry_friction", .unit = "N m"}, j.dry_friction);
    v.number({.name = "damping", .unit = "N m s/rad"}, j.damping);
  });
  for (const config::Node& child : writer.root().children) robot.put(child);
  return config::to_toml(robot);
}

// Returns both ends of a range such as "7 s..14 s"; one may be open.
std::pair<double, double> times_of(const std::string& text) {
  const std::size_t dots = text.find("..");
  const std::string_view from = config::trimmed(std::string_view(text).substr(0, dots)),
                         to = config::trimmed(std::string_view(text).substr(dots + 2));
  const auto time = [](std::string_view end, double open) {
    return end.empty() ? open : config::quantity_setting("hold_out", end, "s");
  };
  const std::pair out{time(from, -unbounded), time(to, unbounded)};
  if (!(out.first < out.second))
    config::fail({"hold_out", 0, 0}, "", config::in_quotes(text),
                 "a time and a later one, such as \"7 s..14 s\"");
  return out;
}

std::vector<std::string> rigs_of(const std::string& text, std::size_t tables) {
  if (text.empty()) return std::vector<std::string>(tables, "rig");
  std::vector<std::string> out = config::at_commas(text);
  if (out.size() == 1) out.resize(tables, out[0]);
  if (out.size() != tables || std::ranges::find(out, "") != out.end())
    config::fail({"rigs", 0, 0}, "", fmt::format("{} names", out.size()),
                 fmt::format("{}: one for each file", tables));
  return out;
}

std::vector<PairRecord> records_of(std::vector<Source> sources, const PairSettings& settings,
                                   const HeldOut& others) {
  const std::vector<Source> held_out = held_out_tables(others, sources, {}, true);
  for (const Source& other : held_out)
    if (std::ranges::find(sources, other.path, &Source::path) == sources.end())
      sources.push_back(other);
  const std::vector<std::string> rigs = rigs_of(settings.rigs, sources.size());
  const double window = SettingValues(settings).of(settings.window);
  std::vector<PairRecord> out;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    Measured all = read_measured(sources[i], pair_columns());
    const std::string_view position = all.has("angle") ? "angle" : "displacement";
    if (all.has(position)) all = times_averaged(std::move(all), 20000, position);
    out.push_back(pair_record(all, window));
    out.back().rig = rigs[i];
    out.back().held_out =
        std::ranges::find(held_out, sources[i].path, &Source::path) != held_out.end();
  }
  return out;
}

}  // namespace

bool is_time_range(std::string_view text) {
  const std::size_t dots = text.find("..");
  if (dots == text.npos) return false;
  const auto time = [](std::string_view end) {
    end = config::trimmed(end);
    return end.empty() || (end[0] >= '0' && end[0] <= '9') || end[0] == '-';
  };
  const std::string_view from = text.substr(0, dots), to = text.substr(dots + 2);
  return time(from) && time(to) && from.size() + to.size() > 0;
}

PairFound find(const SourceList& sources, const PairSettings& settings) {
  if (sources.empty()) config::fail({"data", 0, 0}, "", "no files", "one at least");
  PairOptions options{.model = settings.model, .constraints = Constraints(settings.constraints)};
  HeldOut others{.tables = settings.hold_out.tables};
  std::string times;
  for (const std::string& text : settings.hold_out.texts) {
    if (!is_time_range(text)) {
      if (!std::filesystem::exists(text))
        config::fail({"hold_out", 0, 0}, "", config::in_quotes(text),
                     "times such as \"7 s..14 s\" or \"7 s..\", or a file");
      others.texts.push_back(text);
    } else if (!std::exchange(times, text).empty()) {
      config::fail({"hold_out", 0, 0}, "", "two ranges of time", "one");
    }
  }
  if (!times.empty()) std::tie(options.held_out_from, options.held_out_to) = times_of(times);
  PairFound out{.result = identify_pair(records_of(sources, settings, others), options),
                .joint = settings.joint,
                .base = settings.base};
  out.source = source_words("pair", sources, out.result.report.best().model);
  return out;
}

std::string PairFound::file(const std::string& out) const {
  return pair_file(result, joint, source, robot_over(base, out));
}

Json to_json(const PairFound& found) {
  Json out = to_json(found.result.report);
  out.update(describe(found.result));
  return out;
}

Reports reports_of(const PairFound& found) {
  Reports out{&found.result.report};
  if (found.result.air) out.push_back(&found.result.air->report);
  return out;
}

}  // namespace sinew::identify
