#include "sinew/identify/sensor/readings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "sinew/config/diagnostics.h"
#include "sinew/config/text_file.h"
#include "sinew/recording/columns.h"
#include "sinew/recording/grid.h"
#include "sinew/units/quantity.h"
#include "sinew/units/unit.h"

namespace sinew::identify {

namespace {

using recording::Grid;

constexpr std::array kinds{
    KindFacts{SensorKind::angle, "angle", "rad", "V/rad", "V/rad2"},
    KindFacts{SensorKind::tension, "tension", "N", "V/N", "V/N2"},
    KindFacts{SensorKind::pressure, "pressure", "Pa gauge", "V/Pa", "V/Pa2"},
    KindFacts{SensorKind::velocity, "velocity", "rad/s", "V s/rad", "V s2/rad2"},
    KindFacts{SensorKind::cylinder, "cylinder", "m", "V/m", "V/m2"}};

// Names of a known quantity in a file, and its range.
struct Known {
  SensorKind kind;
  ColumnSpec spec;
};
constexpr std::array names_of_known{
    Known{SensorKind::tension, {"load", "N", 0.01, 1e5, needed_column, "that pulls"}},
    Known{SensorKind::tension, {"force", "N", 0.01, 1e5, needed_column, "that pulls"}},
    Known{SensorKind::tension, {"tension", "N", 0.01, 1e5, needed_column, "that pulls"}},
    Known{SensorKind::angle, {"angle", "rad", 1e-3, 100, needed_column, "of the joint"}},
    Known{SensorKind::cylinder, {"length", "m", 1e-4, 10, needed_column, "of travel"}},
    Known{SensorKind::cylinder, {"position", "m", 1e-4, 10, needed_column, "of travel"}},
    Known{SensorKind::pressure, {"pressure", "Pa gauge", 100, 1e8, needed_column, "in the muscle"}},
    Known{SensorKind::velocity, {"velocity", "rad/s", 1e-3, 1e4, needed_column, "of the joint"}}};

constexpr ColumnSpec time_of_reading{
    .name = "time", .unit = "s", .optional = true, .doc = "of the reading"};

struct Layout {
  const Known* known = nullptr;
  std::string unit;  // unit of the known quantity, as the file or the user gives it
  std::vector<ColumnSpec> sensors;
};

// Finds the columns of a calibration. Returned names are those of the grid and of `only`.
class LayoutFinder {
 public:
  LayoutFinder(const Grid& grid, const Source& source)
      : header_(grid.header()),
        problems_(grid.file),
        columns_(header_, source.names, source.units, source.atmosphere, problems_) {}

  Layout find(const std::string& wanted, const std::vector<std::string>& only) {
    Layout layout;
    for (const Known& known : names_of_known)
      if (wanted.empty() || known.spec.name == wanted) consider(known, layout);
    if (!layout.known) refuse_unknown(wanted);
    std::vector<std::string_view> all;
    for (std::size_t i = 0; i < header_.columns.size(); ++i) {
      const std::string& name = header_.columns[i].name;
      const std::string_view unit = output_unit(i);
      const bool is_first = std::ranges::find(all, name) == all.end();
      if (unit.empty() || !is_first) continue;
      all.push_back(name);
      if (only.empty() || std::ranges::find(only, name) != only.end())
        layout.sensors.push_back({.name = name, .unit = unit, .doc = "of the sensor"});
    }
    for (const std::string& name : only)
      if (std::ranges::find(all, name) == all.end())
        config::fail({"sensors", 0, 0}, "", config::in_quotes(name),
                     all.empty() ? "a column in volts or counts" : config::either(all),
                     config::closest_in_quotes(name, all));
    if (layout.sensors.empty())
      config::fail(first_cell(), "sensor",
                   "no column in volts or counts among " + header_.all_names(),
                   fmt::format("at least one in addition to {}", layout.known->spec.name),
                   "its unit in the header, `gage [V]`, or units.gage=V");
    return layout;
  }

 private:
  config::Location first_cell() const { return {header_.file, header_.line, 1}; }

  // Returns "V" or "count" for a column of a sensor; empty for another one.
  std::string_view output_unit(std::size_t column) const {
    const std::string unit = recording::own_unit(columns_.unit_of(column)).shown;
    const units::UnitReading reading = units::read_unit(unit);
    if (!reading.ok || unit.empty()) return {};
    if (reading.unit.dimension == units::dimension::count) return "count";
    return reading.unit.dimension == units::dimension::voltage ? "V" : "";
  }

  void consider(const Known& known, Layout& layout) const {
    const auto column = columns_.find(known.spec.name);
    if (!column || !output_unit(*column).empty()) return;
    if (layout.known)
      config::fail(first_cell(), "known quantity",
                   fmt::format("both {} and {}", layout.known->spec.name, known.spec.name), "one",
                   fmt::format("known={}", layout.known->spec.name));
    layout.known = &known;
    layout.unit = recording::own_unit(columns_.unit_of(*column)).shown;
  }

  [[noreturn]] void refuse_unknown(const std::string& wanted) const {
    std::vector<std::string_view> names;
    for (const Known& k : names_of_known) names.push_back(k.spec.name);
    if (!wanted.empty() && std::ranges::find(names, wanted) == names.end())
      config::fail({"known", 0, 0}, "", config::in_quotes(wanted), config::either(names),
                   config::closest_in_quotes(wanted, names));
    config::fail(first_cell(), "known quantity", "none among " + header_.all_names(),
                 "a column of what was set: " + config::either(names),
                 "names.load=NAME with the file's name for it");
  }

  const recording::Header& header_;
  config::Problems problems_;
  recording::ColumnResolver columns_;
};

// Throws Refusal for values beyond the converter's range: they come from another source.
void refuse_beyond(const Measured& data, const Column& column, const CountScale& converter) {
  const bool counts = column.unit == "count";
  const double most = counts ? (1 << converter.bits) - 1 : 1.001 * converter.full_scale;
  for (std::size_t i = 0; i < column.values.size(); ++i) {
    const double value = column.values[i];
    if (value <= most && (!counts || value >= 0)) continue;
    config::fail(
        {data.file, data.lines[i], 1}, column.name,
        units::format_quantity(value, column.unit, column.unit),
        counts ? fmt::format("0 to {:g}, the counts of {} bits", most, converter.bits)
               : fmt::format("at most {} V, the converter's full scale", converter.full_scale),
        counts ? "bits=N of your converter, or the columns: they may be swapped"
               : "full_scale=\"10 V\", units.NAME=UNIT for another unit, or the columns: they "
                 "may be swapped");
  }
}

}  // namespace

const KindFacts& facts_of(SensorKind kind) {
  return *std::ranges::find(kinds, kind, &KindFacts::kind);
}

std::vector<ColumnSpec> sensor_columns() {
  std::vector<ColumnSpec> out;
  for (const Known& known : names_of_known) out.push_back(known.spec);
  out.push_back(time_of_reading);
  return out;
}

SensorData parse_sensor_data(std::string_view text, const Source& source,
                             const CountScale& converter, const std::string& known,
                             const std::vector<std::string>& sensors) {
  const Grid grid = recording::read_grid(std::string(text), source);
  const Layout layout = LayoutFinder(grid, source).find(known, sensors);

  // For hanging weights the file contains the mass.
  ColumnSpec first = layout.known->spec;
  const units::UnitReading unit = units::read_unit(layout.unit);
  const bool weighed = layout.known->kind == SensorKind::tension && unit.ok &&
                       unit.unit.dimension == units::dimension::mass;
  if (weighed) {
    first.unit = "kg";
    first.least /= units::standard_gravity;
    first.most /= units::standard_gravity;
  }

  std::vector<ColumnSpec> specs{first, time_of_reading};
  specs.insert(specs.end(), layout.sensors.begin(), layout.sensors.end());
  const Measured data = parse_measured(text, source, specs);

  SensorData out{.file = data.file, .kind = layout.known->kind, .lines = data.lines};
  out.notes = data.notes;
  out.known = data[first.name];
  out.display = !weighed ? layout.unit : layout.unit == "lb" ? "lbf" : "N";
  if (weighed) {
    for (double& x : out.known) x *= units::standard_gravity;
    out.notes.emplace_back("the loads are masses: they pull with 9.80665 m/s2");
  }
  for (const Column& column : data.columns) {
    if (column.name == first.name || column.name == "time") continue;
    refuse_beyond(data, column, converter);
    SensorReadings s{.name = column.name, .volts = column.values};
    s.counted = column.unit == "count";
    if (s.counted)
      for (double& v : s.volts) v *= converter.volts_per_count();
    out.sensors.push_back(std::move(s));
  }
  return out;
}

SensorData read_sensor_data(const Source& source, const CountScale& converter,
                            const std::string& known, const std::vector<std::string>& sensors) {
  return parse_sensor_data(text_of(source, "a calibration as CSV"), source, converter, known,
                           sensors);
}

}  // namespace sinew::identify
