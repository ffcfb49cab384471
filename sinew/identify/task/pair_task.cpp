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
#include "sinew/config/setting.h"
#include "sinew/config/write/writer.h"
#include "sinew/identify/contest/fit.h"
#include "sinew/identify/contest/provenance.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/data/averaged.h"
#include "sinew/identify/pair/pair.h"
#include "sinew/identify/task/settings.h"
#include "sinew/json/json.h"
#include "sinew/report/text/text_table.h"
#include "sinew/units/letters.h"
#include "sinew/units/shown.h"

namespace sinew::identify {

namespace {

// Losses of a joint in a robot's file.
struct JointLosses {
  std::string name;
  double damping = std::numeric_limits<double>::quiet_NaN(), dry_friction = damping;
};

// Returns a robot's file with damping and dry friction of the named joint, whose pair was measured.
// A loss that the law does not have is left out. The file of a slide, which is not a joint, is
// refused.
ParameterFile file_of(const PairResult& found, const std::string& joint, const std::string& source,
                      const std::string& base) {
  if (!found.rotary)
    return {[](const std::string&) -> std::string {
      throw Refusal("out", "a slide",
                    "torque and angle of a joint: in a robot's file muscles move joints, and these "
                    "alone have dry_friction and damping. Of a slide N/m and N s/m have no place "
                    "there, as long as no lever turns them into N m",
                    "no file: the report and its JSON have all values");
    }};
  Provenance provenance;
  std::vector<JointLosses> joints{{.name = joint}};
  const std::string path = "joint." + joint + ".";
  if (const Estimate* e = found.report.best().estimate("viscous")) {
    joints[0].damping = e->value;
    provenance.fitted(path + "damping", *e, source);
  }
  if (const Estimate* e = found.report.best().estimate("friction")) {
    joints[0].dry_friction = e->value;
    provenance.fitted(path + "dry_friction", *e, source + ", with that of the muscles");
  }
  config::Writer writer(&provenance.origins());
  writer.each({.name = "joint"}, joints, [](auto& v, JointLosses& j) {
    v.number({.name = "dry_friction", .unit = "N m"}, j.dry_friction);
    v.number({.name = "damping", .unit = "N m s/rad"}, j.damping);
  });
  return part_of_robot(writer.root(), base);
}

// Returns both ends of a range such as "7 s..14 s"; one may be open.
std::pair<double, double> times_of(const std::string& text) {
  const std::size_t dots = text.find("..");
  const std::string_view from = units::trimmed(std::string_view(text).substr(0, dots)),
                         to = units::trimmed(std::string_view(text).substr(dots + 2));
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

std::vector<PairRecord> records_of(const std::vector<MarkedSource>& sources,
                                   const PairSettings& settings) {
  const std::vector<std::string> rigs = rigs_of(settings.rigs, sources.size());
  const double window = SettingValues(settings).of(settings.window);
  std::vector<PairRecord> out;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    Measured all = read_measured(sources[i].source, pair_columns());
    const std::string_view position = all.has("angle") ? "angle" : "displacement";
    if (all.has(position)) all = times_averaged(std::move(all), 20000, position);
    out.push_back(pair_record(all, window));
    out.back().rig = rigs[i];
    out.back().held_out = sources[i].held_out;
  }
  return out;
}

// Prints the share of the variance that each law explains, and its scores on the held-out rows.
void put_explained(std::string& out, const Report& report) {
  using enum report::TextTable::Align;
  report::TextTable table({"model", "R2", "held out", "nrmse", "r"},
                          {left, right, right, right, right});
  for (const Fit& f : report.fits) {
    if (!f.refused.empty()) continue;
    const Score unseen = f.held_out.value_or(Score{});
    table.add({f.model, fmt::format("{:.4f}", f.fit.explained), digits(unseen.explained, "{:.4f}"),
               digits(unseen.nrmse, "{:.4f}"), digits(unseen.correlation, "{:.4f}")});
  }
  put(out, "\n{}", table.text());
}

void put_stiffness(std::string& out, const PairResult& found, const config::UnitsToShow& chosen) {
  const char* unit = found.rotary ? "N m/rad" : "N/m";
  const units::ShownUnit shown = chosen.units.of(unit);
  const PairStiffness& s = found.stiffness;
  put(out, "\nstiffness, springs and trapped air together: {:.5g} +- {:.2g} {}", shown.of(s.value),
      shown.of(s.uncertainty), shown.name);
  if (std::isfinite(s.air)) put(out, ", {:.4g} {} by the air", shown.of(s.air), shown.name);
  put(out, "\n");
}

// Law and parameters of the trapped air.
void put_air(std::string& out, const PairResult& found) {
  if (!found.air) return;
  const PairAir& air = *found.air;
  const Fit& best = air.report.best();
  put(out, "\ntrapped air, {}: {}; {:.2f} % of {}\n", best.model, best.law, best.fit.rmse_percent,
      air.report.full_scale_is);
  using enum report::TextTable::Align;
  report::TextTable table({"parameter", "value", "unit", "95 %"}, {left, right, left, left});
  for (const Estimate& e : best.parameters)
    table.add({e.name, fmt::format("{:.6g}", e.value), e.unit,
               !e.free                  ? e.known
               : e.at_bound             ? "at the bound of its range"
               : !std::isfinite(e.high) ? "not identifiable"
                                        : fmt::format("+- {:.2g}", 0.5 * (e.high - e.low))});
  put(out, "{}", table.text());
}

void put_pair(const PairFound& found, const TextOptions& how, std::string& out) {
  put_explained(out, found.result.report);
  put_stiffness(out, found.result, how.units);
  put_air(out, found.result);
}

void add_json(const PairResult& result, Json& out) {
  const bool rotary = result.rotary;
  const std::string per = rotary ? "_Nm_per_rad" : "_N_per_m", effort = rotary ? "_Nm" : "_N";
  out["stiffness" + per] = result.stiffness.value;
  out["stiffness_uncertainty" + per] = result.stiffness.uncertainty;
  out["stiffness_of_air" + per] = finite_or_null(result.stiffness.air);
  for (const PairSensorsOf& s : result.sensors)
    out["recordings"].push_back({{"file", s.file},
                                 {"rig", s.rig},
                                 {"bias" + effort, s.sensors.bias},
                                 {"gain", s.sensors.gain},
                                 {"delay_s", s.sensors.delay}});
  if (!result.air) return;
  Json air{{"change_per_position_Pa_per_" + std::string(rotary ? "rad" : "m"),
            result.air->per_position}};
  for (std::size_t m = 0; m < result.air->slope.size(); ++m)
    air["muscles"].push_back(
        {{"pressure_Pa_abs", result.air->pressure[m]},
         {rotary ? "relative_change_1_per_rad" : "relative_change_1_per_m", result.air->slope[m]},
         {"falls", static_cast<bool>(result.air->falls[m])}});
  air["report"] = to_json(result.air->report);
  out["air"] = air;
}

}  // namespace

bool is_time_range(std::string_view text) {
  const std::size_t dots = text.find("..");
  if (dots == text.npos) return false;
  const auto time = [](std::string_view end) {
    end = units::trimmed(end);
    return end.empty() || (end[0] >= '0' && end[0] <= '9') || end[0] == '-';
  };
  const std::string_view from = text.substr(0, dots), to = text.substr(dots + 2);
  return time(from) && time(to) && from.size() + to.size() > 0;
}

PairFound find(const SourceList& sources, const PairSettings& settings) {
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
  PairFound out(identify_pair(records_of(marked_tables(others, sources), settings), options));
  out.files = {file_of(out.result, settings.joint,
                       source_words("pair", sources, out.result.report.best().model),
                       settings.base)};
  if (out.result.air) out.reports.push_back(out.result.air->report);
  add_json(out.result, out.json);
  prints(out, put_pair);
  return out;
}

}  // namespace sinew::identify
