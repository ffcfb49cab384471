#include "sinew/identify/task/dynamic_task.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "sinew/config/diagnostics.h"
#include "sinew/config/named.h"
#include "sinew/config/setting.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/identify/fit/report_json.h"
#include "sinew/identify/motion/dynamic_file.h"
#include "sinew/json/json.h"

namespace sinew::identify {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// One value for all tables, or one for each.
std::vector<double> per_table(std::string_view name, const std::string& text, std::string_view unit,
                              double atmosphere, std::size_t tables, const config::Range& range) {
  std::vector<double> out;
  for (const std::string& piece : config::at_commas(text))
    out.push_back(config::quantity_setting(name, piece, unit, atmosphere, range));
  if (out.size() == 1) out.resize(tables, out[0]);
  if (out.size() != tables)
    config::fail({std::string(name), 0, 0}, "", fmt::format("{} values", out.size()),
                 fmt::format("one, or {}: one for each file", tables));
  return out;
}

bool is_among(const std::vector<Source>& sources, const std::string& path) {
  return std::ranges::find(sources, path, &Source::path) != sources.end();
}

std::vector<DecayRecord> records_of(std::vector<Source> sources, const DynamicSettings& settings,
                                    const actuator::Actuator& a) {
  for (const Source& other : settings.held_out)
    if (!is_among(sources, other.path)) sources.push_back(other);
  const double atmosphere = sources[0].atmosphere;
  const std::size_t n = sources.size();
  const std::vector<double> mass = per_table("mass", settings.mass, "kg", atmosphere, n,
                                             config::above_zero(1e6, "hangs on the muscle"));
  const std::vector<double> external = per_table("external_volume", settings.external_volume, "m3",
                                                 atmosphere, n, config::air_volume);
  std::vector<double> pressure(n, unknown);
  if (!settings.pressure.empty())
    pressure =
        per_table("pressure", settings.pressure, "Pa abs", atmosphere, n, config::air_pressure);
  const bool given = !settings.exponent.empty();
  const double exponent = given ? config::quantity_setting("exponent", settings.exponent, "1",
                                                           atmosphere, config::polytropic)
                                : 1.4;
  std::vector<DecayRecord> out;
  for (std::size_t i = 0; i < n; ++i) {
    DecayRecord r{.data = read_measured(sources[i], decay_columns())};
    r.stand = {.actuator = a,
               .mass = mass[i] / settings.count,
               .pressure = pressure[i],
               .external_volume = external[i] / settings.count,
               .polytropic_exponent = !given && r.data.has("pressure") ? unknown : exponent,
               .atmosphere = atmosphere,
               .gravity = units::standard_gravity};
    r.held_out = is_among(settings.held_out, sources[i].path);
    out.push_back(std::move(r));
  }
  return out;
}

}  // namespace

DynamicFound find_dynamic(const std::vector<Source>& sources, const DynamicSettings& settings) {
  if (sources.empty()) config::fail({"data", 0, 0}, "", "no files", "one at least");
  (void)config::number_setting("count", settings.count, {1, 100, "actuators in parallel"});
  const experiment::MachineFile start = experiment::load_machine_file(settings.actuator);
  const actuator::Actuator& a =
      config::named(start.experiment.actuators, settings.name, "name", "actuator");
  DynamicFound out{
      identify_dynamic(records_of(sources, settings, a), settings.model, Wishes(settings.wishes)),
      ""};
  std::vector<std::string> files;
  for (const Source& source : sources) files.push_back(source.path);
  out.file = loss_file(start.experiment.origins, settings.actuator, a, out.result, files);
  return out;
}

Json to_json(const DynamicFound& found) {
  Json out = to_json(found.result.report);
  out.update(describe(found.result));
  return out;
}

}  // namespace sinew::identify
