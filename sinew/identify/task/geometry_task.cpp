#include "sinew/identify/task/geometry_task.h"

#include <fmt/format.h>

#include "sinew/config/diagnostics.h"
#include "sinew/config/setting.h"
#include "sinew/identify/actuator/geometry_file.h"
#include "sinew/identify/fit/report_json.h"
#include "sinew/identify/task/tables.h"
#include "sinew/json/json.h"

namespace sinew::identify {

namespace {

double thickness_of(const GeometrySettings& settings) {
  return config::quantity_setting("thread_thickness", settings.thread_thickness, "m",
                                  units::atmosphere, config::from_zero(0.1, "of one thread"));
}

}  // namespace

GeometryFound find_geometry(const std::vector<Source>& sources, const GeometrySettings& settings) {
  const Source& source = only_of(sources);
  const double thread = thickness_of(settings);
  const GeometryResult found = identify_geometry(read_measured(source, geometry_columns()), thread);
  return {found.braid, found.report,
          braid_file(found.braid, settings.name, "sinew identify geometry " + source.path,
                     &found.report)};
}

GeometryFound count_geometry(const GeometrySettings& settings) {
  (void)thickness_of(settings);
  std::vector<double> counts;
  for (const std::string& piece : config::at_commas(settings.trapezoids))
    counts.push_back(config::quantity_setting(
        "trapezoids", piece, "1", units::atmosphere,
        {1, 1e5, "at least one each way, and no more than can be counted"}));
  if (counts.size() != 2)
    config::fail({"trapezoids", 0, 0}, "", config::in_quotes(settings.trapezoids),
                 "two counts, lengthwise and around: 37,16");
  const double side =
      config::quantity_setting("side", settings.side, "m", units::atmosphere,
                               config::above_zero(1, "of one trapezoid between two threads"));
  const actuator::Braid braid = actuator::braid_from_trapezoids(counts[0], counts[1], side);
  const std::string source =
      fmt::format("{} x {} trapezoids of {}, [17], [18]", counts[0], counts[1], settings.side);
  return {braid, {}, braid_file(braid, settings.name, source)};
}

Json to_json(const GeometryFound& found) {
  Json out = Json::object();
  if (found.report) out = to_json(*found.report);
  out.update(describe(found.braid));
  return out;
}

}  // namespace sinew::identify
