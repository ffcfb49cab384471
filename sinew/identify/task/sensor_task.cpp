#include "sinew/identify/task/sensor_task.h"

#include <fmt/format.h>

#include "sinew/config/diagnostics.h"
#include "sinew/config/setting.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/identify/fit/robot_over.h"
#include "sinew/identify/sensor/sensor_file.h"
#include "sinew/identify/task/tables.h"

namespace sinew::identify {

namespace {

// Returns the known value at rest [SI], which is text in the unit of what was set, or "0.1 SI".
double rest_of(const std::string& text, std::string_view unit) {
  if (text.empty()) return 0;
  if (text.ends_with(" SI"))
    return config::quantity_setting("rest", text.substr(0, text.size() - 3), "1");
  return config::quantity_setting("rest", text, unit);
}

// The base must have these sensors, of this kind.
void check_base(const std::string& base, const Calibration& c) {
  if (base.empty()) return;
  const auto file = experiment::load_machine_file(base);
  for (const SensorResult& r : c.sensors) {
    const robot::Sensor& s = config::named(file.experiment.robot.sensors, r.name, "base", "sensor");
    if (s.kind != kind_of(c.kind))
      config::fail({base, 0, 0}, "sensor." + r.name + ".kind", "another kind",
                   std::string(facts_of(c.kind).word));
  }
}

void warn_below_zero(Calibration& c) {
  for (const SensorResult& r : c.sensors)
    if (r.at_rest < 0)
      c.warnings.push_back(fmt::format(
          "{}: {:.3g} V at rest, below what a converter reads: the file says 0 count; rest=VALUE "
          "tells where rest is",
          r.name, r.at_rest));
}

}  // namespace

SensorFound find_sensors(const std::vector<Source>& sources, const SensorSettings& settings) {
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
  return {std::move(c), data.display, converter, settings.average, settings.base};
}

std::string SensorFound::file(const std::string& out) const {
  return sensor_file(calibration, converter, average, robot_over(base, out));
}

}  // namespace sinew::identify
