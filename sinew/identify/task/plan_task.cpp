#include "sinew/identify/task/methods.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sinew/config/diagnostics.h"
#include "sinew/config/setting.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/json/json.h"
#include "sinew/report/text/text_table.h"
#include "sinew/units/quantity.h"

namespace sinew::identify {

namespace {

// Reads the settings of a plan in SI.
class PlanReader {
 public:
  PlanReader(const PlanSettings& settings, double room)
      : settings_(settings), values_(settings, room) {}

  const SettingValues& values() const { return values_; }

  // Throws config::Error with `name` if a required setting is missing.
  double needed(std::string_view name, const std::string& member, std::string_view what) const {
    if (member.empty())
      config::fail({std::string(name), 0, 0}, "", "nothing", std::string(what),
                   fmt::format("{}=\"{}\"", name,
                               name == "pressure"   ? "600 kPa gauge"
                               : name == "diameter" ? "12 mm"
                                                    : "250 mm"));
    return values_.of(member);
  }

  PlanOptions options(std::string_view usual_noise) const {
    PlanOptions out;
    out.noise = values_.of(settings_.noise, usual_noise);
    out.length_error = values_.of(settings_.length_error);
    out.law_error = values_.of(settings_.law_error);
    out.error = values_.of(settings_.error);
    out.mount_time = values_.of(settings_.mount_time);
    out.step_time = values_.of(settings_.step_time);
    out.most = settings_.most;
    if (settings_.criterion == "worst") out.criterion = PlanCriterion::worst;
    const double least = out.law_error * (out.criterion == PlanCriterion::worst ? 1.96 : 1);
    if (out.error <= least)
      config::fail({"error", 0, 0}, "", config::in_quotes(settings_.error),
                   fmt::format("above {:.3g} %: so far the law itself is off, whatever is measured",
                               100 * least),
                   "a larger one, or law_error=\"0.3 %\" where the law is known to be better");
    return out;
  }

  PlanRegion region(const ExpectedMuscle& muscle) const {
    PlanRegion out = region_of(muscle);
    const double lowest = free_length(muscle);
    out.shortest = values_.given(settings_.shortest).value_or(out.shortest);
    out.longest = values_.given(settings_.longest).value_or(out.longest);
    out.lowest = values_.given(settings_.lowest).value_or(out.lowest);
    if (out.longest - out.shortest < 0.01 * out.longest)
      config::fail(
          {"longest", 0, 0}, "", units::format_quantity(out.longest, "m", "mm", 4),
          "at least 1 % above the shortest, " + units::format_quantity(out.shortest, "m", "mm", 4));
    if (out.longest <= lowest)
      config::fail({"longest", 0, 0}, "", units::format_quantity(out.longest, "m", "mm", 4),
                   "a length at which the muscle pulls, above " +
                       units::format_quantity(lowest, "m", "mm", 4));
    if (out.lowest > 0.9 * out.highest)
      config::fail({"lowest", 0, 0}, "",
                   units::format_quantity(out.lowest, "Pa gauge", "kPa gauge", 4),
                   "well below the highest, " +
                       units::format_quantity(out.highest, "Pa gauge", "kPa gauge", 4));
    return out;
  }

 private:
  const PlanSettings& settings_;
  SettingValues values_;
};

void add_assumptions(PlanFound& out) {
  const double full = out.muscle.scales.full_scale;
  out.remarks.notes.push_back(fmt::format(
      "The largest force is taken for {:.0f} N; the noise of a reading for {:.3g} N, the error of "
      "a mount's length for {:.2g} mm.",
      full, out.options.noise, 1e3 * out.options.length_error));
  out.remarks.notes.push_back(fmt::format(
      "The law itself is taken to be off by {:.2g} % wherever it was not measured; that "
      "is in every error, and no measurement lowers it.",
      100 * out.options.law_error));
}

// Returns a table with a row for each reading, in order, with an empty column of forces.
std::string table_of(const PlanFound& found) {
  const MeasurementPlan& plan = found.plan;
  std::string out = fmt::format(
      "# Plan of `sinew identify plan`: {} mounts, {} readings, {:.0f} minutes, for {}.\n"
      "# Expected afterwards: {:.2g} % of the largest force, root mean square.\n"
      "# Fill in force [N], and the lengths and pressures that you really had; leave out what you "
      "did not measure.\n"
      "length [mm],pressure [kPa gauge],force [N],branch,rest_length [mm]\n",
      plan.mounts.size(), plan.readings(), plan.time() / 60, found.subject, 100 * plan.after().rms);
  const auto row = [&](double length, double pressure, const char* branch) {
    out += fmt::format("{:.6g},{:.6g},,{},{:.6g}\n", 1e3 * length, 1e-3 * pressure, branch,
                       1e3 * found.muscle.scales.rest_length);
  };
  for (const PlannedMount& m : plan.mounts) {
    for (const double p : m.pressures) row(m.length, p, "fill");
    for (auto p = m.pressures.rbegin() + 1; p < m.pressures.rend(); ++p) row(m.length, *p, "vent");
  }
  return out;
}

// Above 100 % nothing is known, and the number has no meaning.
std::string percent_or_more(double share) {
  return share > 1 ? "> 100 %" : fmt::format("{:.2g} %", 100 * share);
}

// Numbers in the units that were chosen; else in those of a ruler and a regulator.
struct PlanUnits {
  const TextOptions& how;

  TextOptions::Shown of(double si, const std::string& unit,
                        const TextOptions::Shown& otherwise) const {
    return how.units.is_requested ? how.shown(si, unit) : otherwise;
  }
  TextOptions::Shown length(double x) const { return of(x, "m", {1e3 * x, "mm", 1e3}); }
  TextOptions::Shown pressure(double x) const {
    return of(x, "Pa gauge", {1e-3 * x, "kPa gauge", 1e-3});
  }
  TextOptions::Shown force(double x) const { return of(x, "N", {x, "N", 1}); }
};

std::string text_of(const TextOptions::Shown& r) {
  return fmt::format("{:.4g} {}", r.number, r.unit);
}

std::string numbers_of(const std::vector<double>& pressures, const PlanUnits& units) {
  std::vector<double> out;
  for (const double p : pressures) out.push_back(units.pressure(p).number);
  return fmt::format("{:.4g}", fmt::join(out, " "));
}

void put_mounts(std::string& out, const PlanFound& found, const PlanUnits& units) {
  using enum report::TextTable::Align;
  const std::string over = fmt::format("up and down over [{}]", units.pressure(0).unit);
  report::TextTable table(
      {"mount", "length", over, "readings", "minutes", "error rms", "95 % at worst"},
      {right, right, left, right, right, right, right});
  const MeasurementPlan& plan = found.plan;
  table.add({found.measured > 0 ? "before" : "none", "", "", std::to_string(found.measured), "0",
             percent_or_more(plan.before.rms), percent_or_more(plan.before.half_width)});
  double time = 0;
  for (std::size_t i = 0; i < plan.mounts.size(); ++i) {
    const PlannedMount& m = plan.mounts[i];
    time += m.time;
    table.add({std::to_string(i + 1), text_of(units.length(m.length)),
               numbers_of(m.pressures, units), std::to_string(m.readings()),
               fmt::format("{:.0f}", time / 60), percent_or_more(m.after.rms),
               percent_or_more(m.after.half_width)});
  }
  put(out, "{}", table.text());
}

void put_plan(const PlanFound& found, const TextOptions& how, std::string& out) {
  const PlanUnits units{how};
  const MeasurementPlan& plan = found.plan;
  const PlanRegion& r = plan.region;
  const bool worst = found.options.criterion == PlanCriterion::worst;
  put(out, "plan for {}\n", found.subject);
  put(out, "errors of the force in % of the largest, {}, over {:.4g} to {} and {:.4g} to {}\n\n",
      text_of(units.force(found.muscle.scales.full_scale)), units.length(r.shortest).number,
      text_of(units.length(r.longest)), units.pressure(r.lowest).number,
      text_of(units.pressure(r.highest)));
  put_mounts(out, found, units);
  if (plan.mounts.empty()) {
    put(out, "\nnothing more to measure: {} was wanted\n", percent_or_more(found.options.error));
    return;
  }
  const double after = plan.after().of(found.options.criterion);
  const double before = plan.before.of(found.options.criterion);
  put(out, "\n{} {} and {} readings in {:.0f} minutes: {}{} ({} wanted{}{})\n", plan.mounts.size(),
      plan.mounts.size() == 1 ? "mount" : "mounts", plan.readings(), plan.time() / 60,
      found.measured > 0 ? fmt::format("{} -> ", percent_or_more(before)) : "",
      percent_or_more(after), percent_or_more(found.options.error),
      worst ? ", 95 % at the worst place" : ", rms", plan.reached ? "" : "; not reached");
}

Json json_of_error(const PlanError& error) {
  return {{"rms_percent", 100 * error.rms}, {"half_width_95_percent", 100 * error.half_width}};
}

Json json_of(const PlanFound& found) {
  const MeasurementPlan& plan = found.plan;
  Json out{{"format", "sinew.plan/1"},
           {"for", found.subject},
           {"largest_force_N", found.muscle.scales.full_scale},
           {"rest_length_m", found.muscle.scales.rest_length},
           {"noise_N", found.options.noise},
           {"law_error_percent", 100 * found.options.law_error},
           {"wanted_percent", 100 * found.options.error},
           {"measured_readings", found.measured}};
  out["region"] = {{"shortest_m", plan.region.shortest},
                   {"longest_m", plan.region.longest},
                   {"lowest_Pa", plan.region.lowest},
                   {"highest_Pa", plan.region.highest}};
  out["before"] = json_of_error(plan.before);
  out["mounts"] = Json::array();
  for (const PlannedMount& m : plan.mounts)
    out["mounts"].push_back({{"length_m", m.length},
                             {"gauge_pressures_Pa", m.pressures},
                             {"readings", m.readings()},
                             {"time_s", m.time},
                             {"after", json_of_error(m.after)}});
  out["after"] = json_of_error(plan.after());
  out["reached"] = plan.reached;
  out["readings"] = plan.readings();
  out["time_s"] = plan.time();
  out["notes"] = found.remarks.notes;
  return out;
}

PlanFound planned(PlanFound out, const PlanReader& read, std::span<const MeasuredMount> measured) {
  const PlanRegion region = read.region(out.muscle);
  add_assumptions(out);
  out.plan = plan_measurements(out.muscle, region, out.options, measured);
  if (!out.plan.reached)
    out.remarks.notes.push_back(fmt::format(
        "{} mounts do not reach it: less noise, a better known length of each mount, or more of "
        "them would.",
        out.plan.mounts.size()));
  out.files = {file_with(table_of(out))};
  out.json = json_of(out);
  prints(out, put_plan);
  return out;
}

// The target is just above the law's own error, so that mounts are added as long as possible.
constexpr double wanted = 1.05;  // times the error of the law
constexpr int most_mounts = 3;

Further further_of(const std::vector<StaticPoint>& points, double atmosphere,
                   const std::optional<actuator::Braid>& braid) {
  const FittedMuscle fitted = muscle_by_points(points, atmosphere, braid);
  PlanOptions options{.noise = fitted.scatter, .most = most_mounts};
  options.error = wanted * options.law_error;
  const MeasurementPlan plan =
      plan_measurements(fitted.muscle, region_of(fitted.muscle), options, mounts_of(points));
  Further out{.of = "",
              .readings = points.size(),
              .rms = 100 * (plan.before.rms),
              .half = 100 * (plan.before.half_width),
              .mounts = {},
              .note = ""};
  double time = 0;
  for (const PlannedMount& m : plan.mounts) {
    time += m.time;
    out.mounts.push_back({.length = m.length,
                          .pressures = m.pressures,
                          .readings = m.readings(),
                          .time = time,
                          .rms = 100 * (m.after.rms),
                          .half = 100 * (m.after.half_width)});
  }
  out.note = fmt::format(
      "Expected errors of the richest law, {:.2g} % of them the law's own, which no measurement "
      "lowers. A reading is taken to scatter by {:.2g} N as these did, a mount's length to be off "
      "by {:.1g} mm; a mount takes {:.0f} min, a reading {:.1g} min.",
      100 * (options.law_error), options.noise, 1e3 * options.length_error, options.mount_time / 60,
      options.step_time / 60);
  return out;
}

// Makes a plan for a muscle without measurements.
PlanFound first_plan(const PlanSettings& settings, double atmosphere) {
  const PlanReader read(settings, atmosphere);
  PlanFound out;
  out.options = read.options("2 N");
  const double pressure =
      read.needed("pressure", settings.pressure, "the highest one that will be measured");
  if (settings.actuator.empty()) {
    const double rest = read.needed("rest_length", settings.rest_length,
                                    "the muscle's length without pressure and load");
    const double diameter = read.needed("diameter", settings.diameter,
                                        "that of the mesh without pressure, or an actuator's file");
    if (diameter > 0.5 * rest)
      config::fail({"diameter", 0, 0}, "", config::in_quotes(settings.diameter),
                   "at most half of the rest length: a muscle is longer than wide");
    out.muscle = muscle_by_size(rest, diameter, pressure, atmosphere);
    out.subject = fmt::format("a muscle of {:.4g} mm, {:.3g} mm wide", 1e3 * rest, 1e3 * diameter);
  } else {
    const auto file = experiment::load_machine_file(settings.actuator);
    const auto& a =
        config::named(file.experiment.actuators, "", "actuator", "actuator", settings.actuator);
    double rest = a.prediction.rest_length;
    if (!settings.rest_length.empty() || !(rest > 0))
      rest = read.needed("rest_length", settings.rest_length,
                         "the muscle's length without pressure and load");
    out.muscle = muscle_by_actuator(a, rest, pressure, atmosphere);
    out.subject = fmt::format("a muscle of {:.4g} mm like {}", 1e3 * rest, a.name);
  }
  return planned(std::move(out), read, {});
}

// Makes a plan for measurements in addition to the tables.
PlanFound next_plan(const std::vector<Source>& sources, const PlanSettings& settings) {
  StaticData data = read_static(sources, {.rest_length = settings.rest_length,
                                          .actuator = settings.actuator,
                                          .branch = settings.branch});
  const double atmosphere = sources[0].atmosphere;
  const PlanReader read(settings, atmosphere);
  PlanFound out;
  out.options = read.options("");
  out.measured = data.points.size();
  if (const double longest = give_longest(data.points); longest > 0)
    out.remarks.notes.push_back(fmt::format(
        "No rest length given: the longest, {:.4g} mm, is taken for it.", 1e3 * longest));
  FittedMuscle fitted = muscle_by_points(data.points, atmosphere, known_braid(settings.actuator));
  double& top = fitted.muscle.scales.top_pressure;
  top = read.values().given(settings.pressure).value_or(top);
  out.muscle = fitted.muscle;
  if (settings.noise.empty()) out.options.noise = fitted.scatter;
  out.subject = fmt::format("what {} readings in {}{} leave open", data.points.size(),
                            sources[0].path, sources.size() > 1 ? " and others" : "");
  return planned(std::move(out), read, mounts_of(data.points));
}

}  // namespace

PlanFound find(const SourceList& sources, const PlanSettings& settings, double atmosphere) {
  if (!settings.diameter.empty() && (!sources.empty() || !settings.actuator.empty()))
    config::refuse_setting("diameter", config::in_quotes(settings.diameter),
                           "none with measurements or an actuator's file", "leaving it out");
  return sources.empty() ? first_plan(settings, atmosphere) : next_plan(sources, settings);
}

std::vector<Further> further_measurements(const StaticResult& result, double atmosphere,
                                          const std::optional<actuator::Braid>& braid) {
  std::vector<Further> out;
  for (const StaticMuscle& muscle : result.muscles) {
    try {
      out.push_back(further_of(points_of(result.points, muscle.rest_length), atmosphere, braid));
    } catch (const Refusal&) {
      continue;  // too few points for a plan: the models of the report show what is missing
    }
    if (result.muscles.size() > 1)
      out.back().of = fmt::format("the muscle of {:.4g} mm", 1e3 * muscle.rest_length);
  }
  return out;
}

}  // namespace sinew::identify
