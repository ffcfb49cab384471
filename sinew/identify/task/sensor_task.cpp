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

CountScale converter_of(const SensorSettings& settings) {
  (void)config::number_setting("bits", settings.bits, {1, 16, "of a converter"});
  return {settings.bits,
          config::quantity_setting("full_scale", settings.full_scale, "V", units::atmosphere,
                                   config::above_zero(1000, "of a converter"))};
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
  const CountScale converter = converter_of(settings);
  const SensorData data = read_sensor_data(source, converter, settings.known, settings.sensors);
  const double rest = settings.rest.empty() ? settings.rest_value.value_or(0)
                                            : config::quantity_setting("rest", settings.rest,
                                                                       facts_of(data.kind).unit);
  std::optional<SensorData> other;
  if (settings.held_out)
    other = read_sensor_data(*settings.held_out, converter, settings.known, settings.sensors);
  Calibration c = identify_sensors(data, converter, rest, other ? &*other : nullptr);
  check_base(settings.base, c);
  warn_below_zero(c);
  return {std::move(c), data.display, converter, settings.average, settings.base};
}

std::string SensorFound::file(const std::string& out) const {
  return sensor_file(calibration, converter, average, robot_over(base, out));
}

}  // namespace sinew::identify
