#include "sinew/identify/task/plan_task.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/config/diagnostics.h"
#include "sinew/config/quantity.h"
#include "sinew/config/setting.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/identify/fit/refusal.h"
#include "sinew/json/json.h"

namespace sinew::identify {

namespace {

constexpr config::Range plan_length = config::above_zero(1000, "of an actuator");
constexpr config::Range plan_pressure = config::above_zero(5e6, "above the room's, in a muscle");

// Reads the settings of a plan; `room` is what gauges read against  [Pa].
class PlanReader {
 public:
  PlanReader(const PlanSettings& settings, double room) : settings_(settings), room_(room) {}

  double value(std::string_view name, const std::string& text, std::string_view unit,
               const config::Range& range) const {
    return config::quantity_setting(name, text, unit, room_, range);
  }

  // Throws config::Error for what is needed and not told.
  double needed(std::string_view name, const std::string& text, std::string_view unit,
                const config::Range& range, std::string_view what) const {
    if (text.empty())
      config::fail({std::string(name), 0, 0}, "", "nothing", std::string(what),
                   fmt::format("{}={}", name, unit == "m" ? "\"250 mm\"" : "\"600 kPa gauge\""));
    return value(name, text, unit, range);
  }

  PlanOptions options() const {
    const config::Range share = config::above_zero(0.5, "of the largest force");
    const config::Range time = config::from_zero(86400, "more than a day for one step");
    PlanOptions out;
    out.length_error =
        value("length_error", settings_.length_error, "m", config::from_zero(0.1, "of a mount"));
    out.law_error = value("law_error", settings_.law_error, "1",
                          config::from_zero(0.5, "of the largest force"));
    out.error = value("error", settings_.error, "1", share);
    out.mount_time = value("mount_time", settings_.mount_time, "s", time);
    out.step_time = value("step_time", settings_.step_time, "s", time);
    out.most = settings_.most;
    (void)config::number_setting("most", out.most, {3, 100, "mounts; fewer cannot try a law"});
    if (settings_.criterion != "mean" && settings_.criterion != "worst")
      config::fail({"criterion", 0, 0}, "", config::in_quotes(settings_.criterion),
                   "mean or worst");
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
    const auto take = [&](std::string_view name, const std::string& text, double& place) {
      if (!text.empty()) place = value(name, text, "m", plan_length);
    };
    take("shortest", settings_.shortest, out.shortest);
    take("longest", settings_.longest, out.longest);
    if (!settings_.lowest.empty())
      out.lowest = value("lowest", settings_.lowest, "Pa gauge", plan_pressure);
    if (out.longest - out.shortest < 0.01 * out.longest)
      config::fail({"longest", 0, 0}, "", config::format_quantity(out.longest, "m", "mm", 4),
                   "at least 1 % above the shortest, " +
                       config::format_quantity(out.shortest, "m", "mm", 4));
    if (out.longest <= lowest)
      config::fail({"longest", 0, 0}, "", config::format_quantity(out.longest, "m", "mm", 4),
                   "a length at which the muscle pulls, above " +
                       config::format_quantity(lowest, "m", "mm", 4));
    if (out.lowest > 0.9 * out.highest)
      config::fail({"lowest", 0, 0}, "",
                   config::format_quantity(out.lowest, "Pa gauge", "kPa gauge", 4),
                   "well below the highest, " +
                       config::format_quantity(out.highest, "Pa gauge", "kPa gauge", 4));
    return out;
  }

 private:
  const PlanSettings& settings_;
  double room_;
};

double planned_noise(const PlanReader& read, const std::string& text, const char* otherwise) {
  return read.value("noise", text.empty() ? otherwise : text, "N",
                    config::above_zero(1e4, "of a force"));
}

void tell_what_is_assumed(PlanFound& out) {
  const double full = out.muscle.scales.full_scale;
  out.notes.push_back(fmt::format(
      "The largest force is taken for {:.0f} N; the noise of a reading for {:.3g} N, the error of "
      "a mount's length for {:.2g} mm.",
      full, out.options.noise, 1e3 * out.options.length_error));
  out.notes.push_back(fmt::format(
      "The law itself is taken to be off by {:.2g} % wherever it was not measured; that "
      "is in every error, and no measurement lowers it.",
      100 * out.options.law_error));
}

PlanFound planned(PlanFound out, const PlanReader& read, std::span<const MeasuredMount> measured) {
  const PlanRegion region = read.region(out.muscle);
  tell_what_is_assumed(out);
  out.plan = plan_measurements(out.muscle, region, out.options, measured);
  if (!out.plan.reached)
    out.notes.push_back(fmt::format(
        "{} mounts do not reach it: less noise, a better known length of each mount, or more of "
        "them would.",
        out.plan.mounts.size()));
  return out;
}

// A muscle whose rest length nobody said has its longest length.
void give_longest(std::vector<StaticPoint>& points, std::vector<std::string>& notes) {
  double longest = 0;
  for (const StaticPoint& p : points) longest = std::max(longest, p.length);
  for (StaticPoint& p : points) {
    if (p.rest_length > 0) return;
    p.rest_length = longest;
  }
  notes.push_back(
      fmt::format("No rest length given: the longest, {:.4g} mm, stands for it.", 1e3 * longest));
}

Json json_of_error(const PlanError& error) {
  return {{"rms_percent", 100 * error.rms}, {"half_width_95_percent", 100 * error.half_width}};
}

}  // namespace

PlanFound find_plan(const PlanSettings& settings, double atmosphere) {
  const PlanReader read(settings, atmosphere);
  PlanFound out{.options = read.options()};
  out.options.noise = planned_noise(read, settings.noise, "2 N");
  const double pressure = read.needed("pressure", settings.pressure, "Pa gauge", plan_pressure,
                                      "the highest one that will be measured");
  if (settings.actuator.empty()) {
    const double rest = read.needed("rest_length", settings.rest_length, "m", plan_length,
                                    "the muscle's length without pressure and load");
    const double diameter =
        read.needed("diameter", settings.diameter, "m", config::above_zero(1, "of a muscle"),
                    "that of the mesh without pressure, or an actuator's file");
    if (diameter > 0.5 * rest)
      config::fail({"diameter", 0, 0}, "", config::in_quotes(settings.diameter),
                   "at most half of the rest length: a muscle is longer than wide");
    out.muscle = muscle_by_size(rest, diameter, pressure, atmosphere);
    out.subject = fmt::format("a muscle of {:.4g} mm, {:.3g} mm wide", 1e3 * rest, 1e3 * diameter);
  } else {
    const auto file = experiment::load_machine_file(settings.actuator);
    const auto& a = config::named(file.experiment.actuators, "", "actuator", "actuator");
    double rest = a.prediction.rest_length;
    if (!settings.rest_length.empty() || !(rest > 0))
      rest = read.needed("rest_length", settings.rest_length, "m", plan_length,
                         "the muscle's length without pressure and load");
    out.muscle = muscle_by_actuator(a, rest, pressure, atmosphere);
    out.subject = fmt::format("a muscle of {:.4g} mm like {}", 1e3 * rest, a.name);
  }
  return planned(std::move(out), read, {});
}

PlanFound find_next(const std::vector<Source>& sources, const StaticSettings& how,
                    const PlanSettings& settings) {
  StaticData data = read_static(sources, how);
  const double atmosphere = sources[0].atmosphere;
  const PlanReader read(settings, atmosphere);
  PlanFound out{.options = read.options(), .measured = data.points.size()};
  give_longest(data.points, out.notes);
  std::optional<actuator::Braid> braid;
  if (!how.actuator.empty()) {
    const auto file = experiment::load_machine_file(how.actuator);
    braid = config::named(file.experiment.actuators, "", "actuator", "actuator").braid;
  }
  FittedMuscle fitted = muscle_by_points(data.points, atmosphere, braid);
  if (!settings.pressure.empty())
    fitted.muscle.scales.top_pressure =
        read.value("pressure", settings.pressure, "Pa gauge", plan_pressure);
  out.muscle = fitted.muscle;
  out.options.noise =
      settings.noise.empty() ? fitted.scatter : planned_noise(read, settings.noise, "");
  out.subject = fmt::format("what {} readings in {}{} leave open", data.points.size(),
                            sources[0].path, sources.size() > 1 ? " and others" : "");
  return planned(std::move(out), read, mounts_of(data.points));
}

std::string plan_table(const PlanFound& found) {
  const PlanError after = found.plan.after();
  std::string out = fmt::format(
      "# Plan of `sinew identify plan`: {} mounts, {} readings, {:.0f} minutes, for {}.\n"
      "# Expected afterwards: {:.2g} % of the largest force, root mean square.\n"
      "# Fill in force [N], and the lengths and pressures that you really had; leave out what you "
      "did not measure.\n"
      "length [mm],pressure [kPa gauge],force [N],branch,rest_length [mm]\n",
      found.plan.mounts.size(), found.plan.readings(), found.plan.time() / 60, found.subject,
      100 * after.rms);
  const auto row = [&](double length, double pressure, const char* branch) {
    out += fmt::format("{:.6g},{:.6g},,{},{:.6g}\n", 1e3 * length, 1e-3 * pressure, branch,
                       1e3 * found.muscle.scales.rest_length);
  };
  for (const PlannedMount& m : found.plan.mounts) {
    for (const double p : m.pressures) row(m.length, p, "fill");
    for (auto p = m.pressures.rbegin() + 1; p < m.pressures.rend(); ++p) row(m.length, *p, "vent");
  }
  return out;
}

Json to_json(const PlanFound& found) {
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
  out["notes"] = found.notes;
  return out;
}

}  // namespace sinew::identify
