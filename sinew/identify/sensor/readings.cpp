#include "sinew/identify/sensor/readings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sinew/config/diagnostics.h"
#include "sinew/config/quantity.h"
#include "sinew/config/text_file.h"
#include "sinew/recording/grid.h"
#include "sinew/units/unit.h"

namespace sinew::identify {

namespace {

using recording::Grid;
using recording::Heading;

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
    Known{SensorKind::tension, {"load", "N", 0.01, 1e5, false, "that pulls"}},
    Known{SensorKind::tension, {"force", "N", 0.01, 1e5, false, "that pulls"}},
    Known{SensorKind::tension, {"tension", "N", 0.01, 1e5, false, "that pulls"}},
    Known{SensorKind::angle, {"angle", "rad", 1e-3, 100, false, "of the joint"}},
    Known{SensorKind::cylinder, {"length", "m", 1e-4, 10, false, "of travel"}},
    Known{SensorKind::cylinder, {"position", "m", 1e-4, 10, false, "of travel"}},
    Known{SensorKind::pressure, {"pressure", "Pa gauge", 100, 1e8, false, "in the muscle"}},
    Known{SensorKind::velocity, {"velocity", "rad/s", 1e-3, 1e4, false, "of the joint"}}};

constexpr ColumnSpec time_of_reading{
    .name = "time", .unit = "s", .optional = true, .doc = "of the reading"};

struct Layout {
  const Known* known = nullptr;
  const Heading* known_heading = nullptr;
  std::vector<const Heading*> sensors;
};

class Finder {
 public:
  Finder(const Grid& grid, const Source& source) : grid_(grid), source_(source) {}

  Layout find(const std::string& wanted, const std::vector<std::string>& only) const {
    Layout layout;
    for (const Known& known : names_of_known) consider(known, wanted, layout);
    if (!layout.known) refuse_unknown(wanted);
    for (const Heading& h : grid_.headings())
      if (is_output(h) && (only.empty() || std::ranges::find(only, h.name) != only.end()))
        add_sensor(h, layout);
    for (const std::string& name : only) refuse_missing(name, layout);
    if (layout.sensors.empty())
      config::fail(header(), "sensor", "no column in volts or counts among " + grid_.all_names(),
                   "at least one in addition to " + layout.known_heading->name,
                   "its unit in the header, `gage [V]`, or units.gage=V");
    return layout;
  }

  std::string unit_of(const Heading& h) const {
    const auto override = source_.units.find(h.name);
    return override == source_.units.end() ? h.unit : override->second;
  }

 private:
  config::Location header() const { return {grid_.file, grid_.header_line(), 1}; }

  units::Dimension dimension(const Heading& h) const {
    const std::string unit = unit_of(h);
    const units::UnitReading reading = units::read_unit(unit);
    return reading.ok && !unit.empty() ? reading.unit.dimension : units::dimension::none;
  }

  bool is_output(const Heading& h) const {
    const units::Dimension d = dimension(h);
    return d == units::dimension::voltage || d == units::dimension::count;
  }

  void consider(const Known& known, const std::string& wanted, Layout& layout) const {
    if (!wanted.empty() && known.spec.name != wanted) return;
    const auto mapped = source_.names.find(std::string(known.spec.name));
    const std::string name =
        mapped == source_.names.end() ? std::string(known.spec.name) : mapped->second;
    const auto heading = std::ranges::find(grid_.headings(), name, &Heading::name);
    if (heading == grid_.headings().end() || is_output(*heading)) return;
    if (layout.known)
      config::fail(header(), "known quantity",
                   fmt::format("both {} and {}", layout.known->spec.name, known.spec.name), "one",
                   fmt::format("known={}", layout.known->spec.name));
    layout.known = &known;
    layout.known_heading = &*heading;
  }

  [[noreturn]] void refuse_unknown(const std::string& wanted) const {
    std::vector<std::string_view> names;
    for (const Known& k : names_of_known) names.push_back(k.spec.name);
    if (!wanted.empty() && std::ranges::find(names, wanted) == names.end())
      config::fail({"known", 0, 0}, "", config::in_quotes(wanted), config::either(names),
                   config::closest_in_quotes(wanted, names));
    config::fail(header(), "known quantity", "none among " + grid_.all_names(),
                 "a column of what was set: " + config::either(names),
                 "names.load=NAME with the file's name for it");
  }

  void add_sensor(const Heading& h, Layout& layout) const {
    for (const Heading* other : layout.sensors)
      if (other->name == h.name)
        config::fail({grid_.file, grid_.header_line(), h.column}, "sensor",
                     fmt::format("two columns {}", config::in_quotes(h.name)),
                     "a name of its own for each", "");
    layout.sensors.push_back(&h);
  }

  void refuse_missing(const std::string& name, const Layout& layout) const {
    std::vector<std::string_view> names;
    for (const Heading& h : grid_.headings())
      if (is_output(h)) names.push_back(h.name);
    if (std::ranges::find(layout.sensors, name, &Heading::name) == layout.sensors.end())
      config::fail({"sensors", 0, 0}, "", config::in_quotes(name),
                   names.empty() ? "a column in volts or counts" : config::either(names),
                   config::closest_in_quotes(name, names));
  }

  const Grid& grid_;
  const Source& source_;
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
        config::format_quantity(value, column.unit, column.unit),
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
  const Finder finder(grid, source);
  const Layout layout = finder.find(known, sensors);

  // For hanging weights the file contains the mass.
  ColumnSpec first = layout.known->spec;
  std::string display = finder.unit_of(*layout.known_heading);
  const units::UnitReading unit = units::read_unit(display);
  const bool weighed = layout.known->kind == SensorKind::tension && unit.ok &&
                       unit.unit.dimension == units::dimension::mass;
  if (weighed) {
    first.unit = "kg";
    first.least /= units::standard_gravity;
    first.most /= units::standard_gravity;
  }

  std::vector<ColumnSpec> specs{first, time_of_reading};
  for (const Heading* h : layout.sensors) {
    const bool counts =
        units::read_unit(finder.unit_of(*h)).unit.dimension == units::dimension::count;
    specs.push_back({.name = h->name, .unit = counts ? "count" : "V", .doc = "of the sensor"});
  }
  const Measured data = parse_measured(text, source, specs);

  SensorData out{.file = data.file, .kind = layout.known->kind, .lines = data.lines};
  out.notes = data.notes;
  out.known = data[first.name];
  out.display = weighed && display != "lb" ? "N" : weighed ? "lbf" : display;
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
