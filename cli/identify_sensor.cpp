// cli/identify_sensor.cpp - `sinew identify sensor`: calibrations to the sensors of a robot's file.
#include <fmt/format.h>

#include <cmath>

#include "cli/arguments.h"
#include "cli/identify.h"
#include "cli/identify_page.h"
#include "cli/json_text.h"
#include "cli/terminal.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/named.h"
#include "sinew/config/quantity.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/identify/fit/robot_over.h"
#include "sinew/identify/sensor/sensor_file.h"
#include "sinew/report/text/text_table.h"

namespace sinew::cli {

namespace {

using identify::Calibration;
using identify::SensorResult;

struct Options {
  DataOptions data;
  ResultOptions result;
  std::string known, rest, full_scale = "5 V", base, hold_out = "level";
  std::vector<std::string> sensors;
  int bits = 12;
  bool average = false;
};

std::string digits(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "-";
}

std::string percent(double share) { return digits(100 * share, "{:.2f} %"); }

// Table 4-1, and what else one calibration tells of each sensor.
void print_table(const Calibration& c, const std::string& display) {
  using enum report::TextTable::Align;
  const std::string unit = scale_unit(c), shown = scale_unit_for(c, display);
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
  print_table(c, display);
  if (c.sensors.size() == 1) return;
  for (const SensorResult& r : c.sensors)
    for (const std::string& note : r.report.notes) Messages(options.quiet).note(note);
}

// --- the command ---

identify::CountScale converter_of(const Options& options) {
  return {options.bits, argument("--full-scale", options.full_scale, "V", units::atmosphere,
                                 above_zero(1000, "of a converter"))};
}

// The base must have these sensors, of this kind.
void check_base(const Options& options, const Calibration& c) {
  if (options.base.empty()) return;
  const auto file = experiment::load_machine_file(options.base);
  for (const SensorResult& r : c.sensors) {
    const robot::Sensor& s =
        config::named(file.experiment.robot.sensors, r.name, "--base", "sensor");
    if (s.kind != identify::kind_of(c.kind))
      config::fail({options.base, 0, 0}, "sensor." + r.name + ".kind", "another kind",
                   std::string(identify::facts_of(c.kind).word));
  }
}

void warn_below_zero(Calibration& c) {
  for (const SensorResult& r : c.sensors)
    if (r.at_rest < 0)
      c.warnings.push_back(fmt::format(
          "{}: {:.3g} V at rest, below what a converter reads: the file says 0 count; --rest tells "
          "where rest is",
          r.name, r.at_rest));
}

ExitCode run(const Options& options) {
  check_result_options(options.result);
  if (!options.base.empty() && options.result.out.empty())
    config::fail({"--base", 0, 0}, "", "no --out", "a file in which to name the base");
  const std::vector<identify::Source> sources = sources_of(options.data);
  if (sources.size() != 1)
    config::fail({"data", 0, 0}, "", fmt::format("{} files", sources.size()), "one");
  const identify::CountScale converter = converter_of(options);
  const identify::SensorData data =
      read_sensor_data(sources[0], converter, options.known, options.sensors);
  const std::string_view unit = identify::facts_of(data.kind).unit;
  const double rest =
      options.rest.empty() ? 0 : argument("--rest", options.rest, unit, units::atmosphere);

  identify::SensorData other;
  const bool levels = options.hold_out == "level";
  if (!levels) {
    refuse_data_file("--hold-out", options.hold_out, options.data);
    identify::Source source = sources[0];
    source.path = options.hold_out;
    other = read_sensor_data(source, converter, options.known, options.sensors);
  }
  Calibration c = identify_sensors(data, converter, rest, levels ? nullptr : &other);
  check_base(options, c);
  warn_below_zero(c);

  const Messages messages(options.result.quiet);
  for (const std::string& note : c.notes) messages.note(note);
  if (options.result.json)
    fmt::print("{}\n", json_text(to_json(c), 2));
  else
    print(c, data.display, options.result);
  for (const std::string& warning : c.warnings) messages.warning(warning);
  const std::string file = identify::sensor_file(
      c, converter, options.average, identify::robot_over(options.base, options.result.out));
  write_parameter_file(file, options.result);
  std::vector<const identify::Report*> reports;
  for (const SensorResult& r : c.sensors) reports.push_back(&r.report);
  leave_page("calibration of sensors from " + c.file, reports, file, options.data, options.result);
  return ok;
}

}  // namespace

void add_identify_sensor(Command identify, Action& action) {
  auto options = std::make_shared<Options>();
  Command sub = identify.subcommand(
      "sensor", "scale, offset, linearity, hysteresis and noise of calibrated sensors",
      "sinew identify sensor weights.csv --map load=weight -o my-sensors.toml");
  add_data_options(sub, options->data);
  sub.add_option("--known", options->known,
                 "load, force, tension, angle, length, position, pressure or velocity: what was "
                 "set, where the file has several");
  sub.add_option("--sensors", options->sensors, "columns to calibrate; all in volts or counts")
      .split_at(',')
      .takes_one();
  sub.add_option("--rest", options->rest, "the known value at the joint's rest angle; 0");
  sub.add_option("--bits", options->bits, "of the converter").is_between(1, 16).show_default();
  sub.add_option("--full-scale", options->full_scale, "of the converter").show_default();
  sub.add_option("--hold-out", options->hold_out,
                 "level: every known value is predicted from the others; or another calibration")
      .show_default();
  sub.add_flag("--average", options->average,
               "the controller believes in one scale for all of them, as the thesis's did");
  sub.add_option("--base", options->base,
                 "the robot whose sensors these are: the parameter file is then a robot");
  add_result_options(sub, options->result);
  sub.callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace sinew::cli
