// cli/identify_sensor.cpp - `sinew identify sensor`: calibrations to the sensors of a robot's file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "cli/arguments.h"
#include "cli/identify.h"
#include "cli/identify_page.h"
#include "cli/json_text.h"
#include "cli/named.h"
#include "cli/terminal.h"
#include "cli/text_table.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/quantity.h"
#include "sinew/config/writer.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/identify/provenance.h"
#include "sinew/identify/sensor.h"
#include "sinew/robot/sensor.fields.h"

namespace sinew::cli {

namespace {

using Json = nlohmann::ordered_json;
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

robot::Sensor::Kind kind_of(identify::SensorKind kind) {
  using Kind = robot::Sensor::Kind;
  switch (kind) {
    case identify::SensorKind::angle:
      return Kind::angle;
    case identify::SensorKind::tension:
      return Kind::tension;
    case identify::SensorKind::pressure:
      return Kind::pressure;
    case identify::SensorKind::velocity:
      return Kind::velocity;
    case identify::SensorKind::cylinder:
      break;
  }
  return Kind::cylinder;
}

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// Potentiometers are given per volt, transducers in volts.
bool per_volt(identify::SensorKind kind) {
  return kind == identify::SensorKind::angle || kind == identify::SensorKind::cylinder;
}

double scale_of(const Calibration& c, double sensitivity) {
  return per_volt(c.kind) ? 1 / sensitivity : sensitivity;
}

double scale_uncertainty(const Calibration& c, const SensorResult& r) {
  const double relative = r.sensitivity_uncertainty / std::abs(r.sensitivity);
  return relative * std::abs(scale_of(c, r.sensitivity));
}

std::string scale_unit(const Calibration& c) {
  if (c.kind == identify::SensorKind::angle) return "rad/V";
  if (c.kind == identify::SensorKind::cylinder) return "m/V";
  return std::string(identify::facts_of(c.kind).sensitivity);
}

// The same in the file's own units: "V/lbf", "deg/V".
std::string shown_unit(const Calibration& c, const std::string& display) {
  std::string unit = display;
  for (const std::string_view word : {" gauge", " abs"})
    if (unit.ends_with(word)) unit.resize(unit.size() - word.size());
  if (c.kind == identify::SensorKind::velocity || unit.find('/') != unit.npos) return scale_unit(c);
  return per_volt(c.kind) ? unit + "/V" : "V/" + unit;
}

// --- the parameter file ---

robot::Sensor sensor_of(const Calibration& c, const SensorResult& r,
                        const identify::CountScale& converter, bool average) {
  const double per_count = converter.volts_per_count();
  robot::Sensor s{.name = r.name, .kind = kind_of(c.kind)};
  s.scale = scale_of(c, r.sensitivity);
  s.at_rest = std::max(0.0, r.at_rest / per_count);
  s.noise = std::isfinite(r.noise) ? r.noise / per_count : unknown;
  const double believed = average ? scale_of(c, c.average) : s.scale;
  s.assumed_scale = per_volt(c.kind) ? 1 / (believed * per_count) : believed;
  s.assumed_at_rest = s.at_rest;
  return s;
}

void note_origins(const Calibration& c, const SensorResult& r,
                  const identify::CountScale& converter, bool average, const std::string& source,
                  identify::Provenance& provenance) {
  const std::string real = "sensor." + r.name + ".real.",
                    assumed = "sensor." + r.name + ".assumed.";
  provenance.fitted(real + "scale", scale_unit(c), scale_uncertainty(c, r), source);
  provenance.fitted(real + "at_rest", "count", r.at_rest_uncertainty / converter.volts_per_count(),
                    source);
  provenance.fitted(real + "noise", "count", unknown, source + ", repeated readings");
  provenance.given(assumed + "scale", average ? "the average of " + c.file : source);
  provenance.given(assumed + "at_rest", source);
}

std::string parameter_file(const Calibration& c, const identify::CountScale& converter,
                           const Options& options) {
  const std::string source = "sinew identify sensor " + c.file;
  identify::Provenance provenance;
  std::vector<robot::Sensor> sensors;
  for (const SensorResult& r : c.sensors) {
    note_origins(c, r, converter, options.average, source, provenance);
    sensors.push_back(sensor_of(c, r, converter, options.average));
  }
  config::Writer writer(&provenance.origins());
  writer.each({.name = "sensor"}, sensors, [](auto& v, robot::Sensor& s) {
    v.group({.name = "real"}, [&](auto& g) { robot::real_fields(g, s); });
    v.group({.name = "assumed"}, [&](auto& g) { robot::assumed_fields(g, s); });
  });

  config::Node root = robot_over(options.base, options.result.out);
  for (const config::Node& child : writer.root().children) root.put(child);
  return config::to_toml(root);
}

// --- the report ---

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json describe(const Calibration& c, const SensorResult& r) {
  return {{"name", r.name},
          {"kind", identify::facts_of(c.kind).word},
          {"scale", scale_of(c, r.sensitivity)},
          {"scale_unit", scale_unit(c)},
          {"scale_uncertainty", number(scale_uncertainty(c, r))},
          {"sensitivity", r.sensitivity},
          {"sensitivity_unit", identify::facts_of(c.kind).sensitivity},
          {"at_rest_V", r.at_rest},
          {"span_V", r.span},
          {"linearity_percent", 100 * r.linearity},
          {"hysteresis_percent", number(100 * r.hysteresis)},
          {"noise_V", number(r.noise)},
          {"resolution_V", number(r.step)},
          {"deviation_percent", 100 * r.deviation}};
}

Json to_json(const Calibration& c) {
  Json out{{"format", "sinew.identification/1"}, {"subject", "calibration of sensors"}};
  out["average_sensitivity"] = c.average;
  // What there is of a single one stands where other methods have it.
  if (c.sensors.size() == 1) out.update(cli::to_json(c.sensors[0].report));
  out["sensors"] = Json::array();
  for (const SensorResult& r : c.sensors) {
    Json one = describe(c, r);
    one.update(cli::to_json(r.report));
    out["sensors"].push_back(one);
  }
  out["notes"] = c.notes;
  out["warnings"] = c.warnings;
  return out;
}

std::string digits(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "-";
}

std::string percent(double share) { return digits(100 * share, "{:.2f} %"); }

// Table 4-1, and what else one calibration tells of each sensor.
void print_table(const Calibration& c, const std::string& display) {
  using enum TextTable::Align;
  const std::string unit = scale_unit(c), shown = shown_unit(c, display);
  TextTable table({"sensor", "scale [" + shown + "]", "95 %", "at rest [V]", "model", "held out",
                   "linearity", "hysteresis", "noise [mV]", "step [mV]", "error from average"},
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
    const robot::Sensor& s = named(file.experiment.robot.sensors, r.name, "--base", "sensor");
    if (s.kind != kind_of(c.kind))
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
  const std::string file = parameter_file(c, converter, options);
  write_parameter_file(file, options.result);
  std::vector<const identify::Report*> reports;
  for (const SensorResult& r : c.sensors) reports.push_back(&r.report);
  leave_page("calibration of sensors from " + c.file, reports, file, options.data, options.result);
  return ok;
}

}  // namespace

void add_identify_sensor(CLI::App& identify, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App& sub = subcommand(
      identify, "sensor", "scale, offset, linearity, hysteresis and noise of calibrated sensors",
      "sinew identify sensor weights.csv --map load=weight -o my-sensors.toml");
  add_data_options(sub, options->data);
  sub.add_option("--known", options->known,
                 "load, force, tension, angle, length, position, pressure or velocity: what was "
                 "set, where the file has several");
  sub.add_option("--sensors", options->sensors, "columns to calibrate; all in volts or counts")
      ->delimiter(',')
      ->allow_extra_args(false);
  sub.add_option("--rest", options->rest, "the known value at the joint's rest angle; 0");
  sub.add_option("--bits", options->bits, "of the converter")
      ->check(CLI::Range(1, 16))
      ->capture_default_str();
  sub.add_option("--full-scale", options->full_scale, "of the converter")->capture_default_str();
  sub.add_option("--hold-out", options->hold_out,
                 "level: every known value is predicted from the others; or another calibration")
      ->capture_default_str();
  sub.add_flag("--average", options->average,
               "the controller believes in one scale for all of them, as the thesis's did");
  sub.add_option("--base", options->base,
                 "the robot whose sensors these are: the parameter file is then a robot");
  add_result_options(sub, options->result);
  sub.callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace sinew::cli
