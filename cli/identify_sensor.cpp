// cli/identify_sensor.cpp - `sinew identify sensor`: calibrations to the sensors of a robot's file.
#include <fmt/format.h>

#include <cmath>

#include "cli/identify.h"
#include "cli/identify_page.h"
#include "cli/terminal.h"
#include "cli/units.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/quantity.h"
#include "sinew/identify/sensor/sensor_file.h"
#include "sinew/identify/task/sensor_task.h"
#include "sinew/identify/task/tables.h"
#include "sinew/report/text/text_table.h"

namespace sinew::cli {

namespace {

using identify::Calibration;
using identify::SensorResult;

struct IdentifySensorOptions {
  DataOptions data;
  ResultOptions result;
  identify::SensorSettings settings;
  std::string hold_out = "level";
};

std::string digits(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "-";
}

std::string percent(double share) { return digits(100 * share, "{:.2f} %"); }

// The unit of a scale: one that was asked for, else one of what was set, as the files have it.
std::string shown_scale(const Calibration& c, const std::string& display,
                        const ResultOptions& options) {
  const config::UnitsToShow asked = units_asked(options.units, units::UnitSet::si);
  if (!asked.asked) return scale_unit_for(c, display);
  const std::string unit = scale_unit(c);
  if (units::told_unit(unit)) return asked.units.of(unit).name;
  const auto told = units::told_unit(display);
  return scale_unit_for(c, told ? asked.units.of(told->held).name : display);
}

// Table 4-1, and what else one calibration tells of each sensor.
void print_table(const Calibration& c, const std::string& shown) {
  using enum report::TextTable::Align;
  const std::string unit = scale_unit(c);
  report::TextTable table(
      {"sensor", "scale [" + shown + "]", "95 %", "at rest [V]", "model", "held out", "linearity",
       "hysteresis", "noise [mV]", "step [mV]", "error from average"},
      {left, right, right, right, left, right, right, right, right, right, right});
  const auto add = [&](const std::string& name, double sensitivity, auto... rest) {
    const double scale = config::convert(scale_of(c, sensitivity), unit, shown);
    table.add({name, digits(scale, "{:.5g}"), rest...});
  };
  for (const SensorResult& r : c.sensors) {
    const identify::Fit& best = r.report.best();
    add(r.name, r.sensitivity,
        digits(config::convert(scale_uncertainty(c, r), unit, shown), "+- {:.2g}"),
        digits(r.at_rest, "{:.4f}"), best.model,
        best.held_out ? percent(best.held_out->rmse_percent / 100) : "-", percent(r.linearity),
        percent(r.hysteresis), digits(1000 * r.noise, "{:.2g}"), digits(1000 * r.step, "{:.3g}"),
        c.sensors.size() > 1 ? digits(100 * r.deviation, "{:+.1f} %") : "-");
  }
  if (c.sensors.size() > 1) add("average", c.average);
  fmt::print("{}", table.text());
}

// One sensor's models in full; of several the table, the rest with --json.
void print(const Calibration& c, const std::string& display, const ResultOptions& options) {
  ResultOptions report_only = options;
  report_only.out.clear();
  report_only.no_report = true;
  if (c.sensors.size() == 1) {
    tell(c.sensors[0].report, "", {}, report_only);
    fmt::print("\n");
  }
  print_table(c, shown_scale(c, display, options));
  if (c.sensors.size() == 1) return;
  for (const SensorResult& r : c.sensors)
    for (const std::string& note : r.report.notes) Messages(options.quiet).note(note);
}

// --- the command ---

ExitCode run(const IdentifySensorOptions& options) {
  check_result_options(options.result);
  identify::SensorSettings settings = options.settings;
  if (!settings.base.empty() && options.result.out.empty())
    config::fail({"--base", 0, 0}, "", "no --out", "a file in which to name the base");
  const std::vector<identify::Source> sources = sources_of(options.data, {options.hold_out});
  if (options.hold_out != "level")
    settings.held_out = identify::beside(sources, "hold_out", options.hold_out);
  const identify::SensorFound found = identify::find_sensors(sources, settings);
  const Calibration& c = found.calibration;

  const Messages messages(options.result.quiet);
  for (const std::string& note : c.notes) messages.note(note);
  for (const std::string& warning : c.warnings) messages.warning(warning);
  const std::string file = found.file(options.result.out);
  write_parameter_file(file, options.result);
  std::vector<const identify::Report*> reports;
  for (const SensorResult& r : c.sensors) reports.push_back(&r.report);
  leave_page("calibration of sensors from " + c.file, reports, file, options.data, options.result);
  if (options.result.json)
    fmt::print("{}\n", to_json(c).text(2));
  else
    print(c, found.display, options.result);
  return ok;
}

}  // namespace

void add_identify_sensor(Command identify, Action& action) {
  auto options = std::make_shared<IdentifySensorOptions>();
  Command sub = identify.subcommand(
      "sensor", "scale, offset, linearity, hysteresis and noise of calibrated sensors",
      "sinew identify sensor weights.csv --map load=weight -o my-sensors.toml");
  add_data_options(sub, options->data);
  sub.add_option("--known", options->settings.known,
                 "load, force, tension, angle, length, position, pressure or velocity: what was "
                 "set, where the file has several");
  sub.add_option("--sensors", options->settings.sensors,
                 "columns to calibrate; all in volts or counts")
      .split_at(',')
      .takes_one();
  sub.add_option("--rest", options->settings.rest, "the known value at the joint's rest angle; 0");
  sub.add_option("--bits", options->settings.bits, "of the converter")
      .is_between(1, 16)
      .show_default();
  sub.add_option("--full-scale", options->settings.full_scale, "of the converter").show_default();
  sub.add_option("--hold-out", options->hold_out,
                 "level: every known value is predicted from the others; or another calibration")
      .show_default();
  sub.add_flag("--average", options->settings.average,
               "the controller believes in one scale for all of them, as the thesis's did");
  sub.add_option("--base", options->settings.base,
                 "the robot whose sensors these are: the parameter file is then a robot");
  add_result_options(sub, options->result);
  sub.callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace sinew::cli
