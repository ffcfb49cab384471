#include "sinew/identify/task/methods.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sinew/config/diagnostics.h"
#include "sinew/config/setting.h"
#include "sinew/config/write/writer.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/identify/contest/fit.h"
#include "sinew/identify/contest/provenance.h"
#include "sinew/identify/task/settings.h"
#include "sinew/json/json.h"
#include "sinew/report/text/text_table.h"
#include "sinew/robot/sensor.fields.h"
#include "sinew/units/quantity.h"
#include "sinew/units/unit.h"

namespace sinew::identify {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// Returns whether the scale is per volt, as for potentiometers; transducers are given in volts.
bool per_volt(SensorKind kind) { return kind == SensorKind::angle || kind == SensorKind::cylinder; }

}  // namespace

double scale_of(const Calibration& c, double sensitivity) {
  return per_volt(c.kind) ? 1 / sensitivity : sensitivity;
}

double scale_uncertainty(const Calibration& c, const SensorResult& r) {
  const double relative = r.sensitivity_uncertainty / std::abs(r.sensitivity);
  return relative * std::abs(scale_of(c, r.sensitivity));
}

std::string scale_unit(const Calibration& c) {
  if (c.kind == SensorKind::angle) return "rad/V";
  if (c.kind == SensorKind::cylinder) return "m/V";
  return std::string(facts_of(c.kind).sensitivity);
}

std::string scale_unit_for(const Calibration& c, const std::string& display) {
  std::string unit = display;
  for (const std::string_view word : {" gauge", " abs"})
    if (unit.ends_with(word)) unit.resize(unit.size() - word.size());
  if (c.kind == SensorKind::velocity || unit.find('/') != unit.npos) return scale_unit(c);
  return per_volt(c.kind) ? unit + "/V" : "V/" + unit;
}

namespace {

robot::Sensor sensor_of(const Calibration& c, const SensorResult& r, const CountScale& converter,
                        bool average) {
  const double per_count = converter.volts_per_count();
  robot::Sensor s{.name = r.name, .kind = c.kind};
  s.scale = scale_of(c, r.sensitivity);
  s.at_rest = std::max(0.0, r.at_rest / per_count);
  s.noise = std::isfinite(r.noise) ? r.noise / per_count : unknown;
  const double believed = average ? scale_of(c, c.average) : s.scale;
  s.assumed_scale = per_volt(c.kind) ? 1 / (believed * per_count) : believed;
  s.assumed_at_rest = s.at_rest;
  return s;
}

void note_origins(const Calibration& c, const SensorResult& r, const CountScale& converter,
                  bool average, const std::string& source, Provenance& provenance) {
  const std::string real = "sensor." + r.name + ".real.",
                    assumed = "sensor." + r.name + ".assumed.";
  provenance.fitted(real + "scale", scale_unit(c), scale_uncertainty(c, r), source);
  provenance.fitted(real + "at_rest", "count", r.at_rest_uncertainty / converter.volts_per_count(),
                    source);
  provenance.fitted(real + "noise", "count", unknown, source + ", repeated readings");
  provenance.given(assumed + "scale", average ? "the average of " + c.file : source);
  provenance.given(assumed + "at_rest", source);
}

Json describe(const Calibration& c, const SensorResult& r) {
  return {{"name", r.name},
          {"kind", facts_of(c.kind).word},
          {"scale", scale_of(c, r.sensitivity)},
          {"scale_unit", scale_unit(c)},
          {"scale_uncertainty", finite_or_null(scale_uncertainty(c, r))},
          {"sensitivity", r.sensitivity},
          {"sensitivity_unit", facts_of(c.kind).sensitivity},
          {"at_rest_V", r.at_rest},
          {"span_V", r.span},
          {"linearity_percent", 100 * r.linearity},
          {"hysteresis_percent", finite_or_null(100 * r.hysteresis)},
          {"noise_V", finite_or_null(r.noise)},
          {"resolution_V", finite_or_null(r.step)},
          {"deviation_percent", 100 * r.deviation}};
}

// Returns the tables of the sensors in a robot's file. `average`: the controller assumes one scale
// for all sensors, as in the thesis.
config::Node tables_of(const Calibration& c, const CountScale& converter, bool average) {
  const std::string source = "sinew identify sensor " + c.file;
  Provenance provenance;
  std::vector<robot::Sensor> sensors;
  for (const SensorResult& r : c.sensors) {
    note_origins(c, r, converter, average, source, provenance);
    sensors.push_back(sensor_of(c, r, converter, average));
  }
  config::Writer writer(&provenance.origins());
  writer.each({.name = "sensor"}, sensors, [](auto& v, robot::Sensor& s) {
    v.group({.name = "real"}, [&](auto& g) { robot::real_fields(g, s); });
    v.group({.name = "assumed"}, [&](auto& g) { robot::assumed_fields(g, s); });
  });
  return writer.root();
}

// Returns the known value at rest [SI] from a text with a unit, or in SI: "0.1 SI".
double rest_of(const std::string& text, std::string_view unit) {
  if (text.empty()) return 0;
  if (text.ends_with(" SI"))
    return config::quantity_setting("rest", text.substr(0, text.size() - 3), "1");
  return config::quantity_setting("rest", text, unit);
}

// Throws config::Error unless the base has these sensors, with this kind.
void check_base(const std::string& base, const Calibration& c) {
  if (base.empty()) return;
  const auto file = experiment::load_machine_file(base);
  for (const SensorResult& r : c.sensors) {
    const robot::Sensor& s = config::named(file.experiment.robot.sensors, r.name, "base", "sensor");
    if (s.kind != c.kind)
      config::fail({base, 0, 0}, "sensor." + r.name + ".kind", "another kind",
                   std::string(facts_of(c.kind).word));
  }
}

void warn_below_zero(Calibration& c) {
  for (const SensorResult& r : c.sensors)
    if (r.at_rest < 0)
      c.warnings.push_back(fmt::format(
          "{}: {:.3g} V at rest, below what a converter reads: the file has 0 count; rest=VALUE "
          "sets where rest is",
          r.name, r.at_rest));
}

std::string percent(double share) { return digits(100 * share, "{:.2f} %"); }

// Returns the unit of a scale: the chosen one, else that of the known values.
std::string shown_scale(const Calibration& c, const std::string& display,
                        const config::UnitsToShow& chosen) {
  if (!chosen.is_requested) return scale_unit_for(c, display);
  const std::string unit = scale_unit(c);
  if (units::read_quantity_unit(unit)) return chosen.units.of(unit).name;
  const auto given = units::read_quantity_unit(display);
  return scale_unit_for(c, given ? chosen.units.of(given->stored).name : display);
}

// Table 4-1, with model, errors and noise of each sensor.
void put_table(std::string& out, const Calibration& c, const std::string& shown) {
  using enum report::TextTable::Align;
  const std::string unit = scale_unit(c);
  report::TextTable table(
      {"sensor", "scale [" + shown + "]", "95 %", "at rest [V]", "model", "held out", "linearity",
       "hysteresis", "noise [mV]", "step [mV]", "error from average"},
      {left, right, right, right, left, right, right, right, right, right, right});
  const auto add = [&](const std::string& name, double sensitivity, auto... rest) {
    const double scale = units::convert(scale_of(c, sensitivity), unit, shown);
    table.add({name, digits(scale, "{:.5g}"), rest...});
  };
  for (const SensorResult& r : c.sensors) {
    const Fit& best = r.report.best();
    add(r.name, r.sensitivity,
        digits(units::convert(scale_uncertainty(c, r), unit, shown), "+- {:.2g}"),
        digits(r.at_rest, "{:.4f}"), best.model,
        best.held_out ? percent(best.held_out->rmse_percent / 100) : "-", percent(r.linearity),
        percent(r.hysteresis), digits(1000 * r.noise, "{:.2g}"), digits(1000 * r.step, "{:.3g}"),
        c.sensors.size() > 1 ? digits(100 * r.deviation, "{:+.1f} %") : "-");
  }
  if (c.sensors.size() > 1) add("average", c.average);
  put(out, "{}", table.text());
}

void put_calibration(const SensorFound& found, const TextOptions& how, std::string& out) {
  const Calibration& c = found.calibration;
  if (c.sensors.size() == 1) put(out, "\n");
  put_table(out, c, shown_scale(c, found.display, how.units));
}

Json json_of(const Calibration& c) {
  Json out{{"format", "sinew.identification/1"}, {"subject", "calibration of sensors"}};
  out["average_sensitivity"] = c.average;
  // The values of a single transducer are at top level, as for other methods.
  if (c.sensors.size() == 1) out.update(to_json(c.sensors[0].report));
  out["sensors"] = Json::array();
  for (const SensorResult& r : c.sensors) {
    Json one = describe(c, r);
    one.update(to_json(r.report));
    out["sensors"].push_back(one);
  }
  out["notes"] = c.notes;
  out["warnings"] = c.warnings;
  return out;
}

}  // namespace

SensorFound find(const SourceList& sources, const SensorSettings& settings) {
  const Source& source = only_of(sources);
  const CountScale converter{settings.bits, SettingValues(settings).of(settings.full_scale)};
  const SensorData data = read_sensor_data(source, converter, settings.known, settings.sensors);
  const double rest = rest_of(settings.rest, facts_of(data.kind).unit);
  constexpr std::string_view level[] = {"level"};
  std::optional<SensorData> other;
  for (const Source& table : held_out_tables(settings.hold_out, sources, level))
    other = read_sensor_data(table, converter, settings.known, settings.sensors);
  Calibration c = identify_sensors(data, converter, rest, other ? &*other : nullptr);
  check_base(settings.base, c);
  warn_below_zero(c);
  SensorFound out;
  out.files = {part_of_robot(tables_of(c, converter, settings.average), settings.base)};
  for (const SensorResult& sensor : c.sensors) out.reports.push_back(sensor.report);
  out.is_report_text = out.reports.size() == 1;
  out.title = "calibration of sensors from " + c.file;
  out.remarks = {c.notes, c.warnings};
  if (!out.is_report_text)
    for (const Report& r : out.reports)
      out.remarks.notes.insert(out.remarks.notes.end(), r.notes.begin(), r.notes.end());
  out.json = json_of(c);
  out.calibration = std::move(c);
  out.display = data.display;
  prints(out, put_calibration);
  return out;
}

}  // namespace sinew::identify
