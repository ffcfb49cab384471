#include "sinew/identify/task/methods.h"

#include <fmt/format.h>

#include <string>

#include "sinew/actuator/actuator.h"
#include "sinew/actuator/braid.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/setting.h"
#include "sinew/identify/contest/fit.h"
#include "sinew/identify/contest/provenance.h"
#include "sinew/identify/data/quality.h"
#include "sinew/identify/task/settings.h"
#include "sinew/json/json.h"
#include "sinew/units/quantity.h"

namespace sinew::identify {

namespace {

// Returns an actuator with this braid and guesses for the rest, so that the file can be read: the
// mesh ends where its threads are straight, and there are no losses.
actuator::Actuator actuator_of(const actuator::Braid& braid, const std::string& name,
                               const std::string& source, const Report* report,
                               Provenance& provenance) {
  actuator::Actuator a;
  a.name = name;
  a.braid = braid;
  for (const char* key : {"thread_length", "turns"})
    provenance.fitted("actuator." + name + ".braid." + key,
                      report ? report->best().estimate(key) : nullptr, source, source);
  guess_ends(0.93 * braid.thread_length, "as the thesis's share of the thread's length", a,
             provenance);
  return a;
}

void put_braid(const GeometryFound& found, const TextOptions& how, std::string& out) {
  if (!found.reports.empty()) return;
  const config::UnitsToShow chosen = how.units;
  const std::string unit = chosen.is_requested ? chosen.units.of("m").name : "mm";
  put(out, "thread_length  {}  [17]\nturns          {}  [18]\nshortest       {}  [5], [6]\n",
      units::format_quantity(found.braid.thread_length, "m", unit),
      units::format_number(found.braid.turns),
      units::format_quantity(actuator::shortest_length(found.braid), "m", unit));
}

// Returns the result with an actuator's file of this braid and guesses for the rest.
GeometryFound found_of(const actuator::Braid& braid, const Report* report, const std::string& name,
                       const std::string& source) {
  GeometryFound out;
  out.braid = braid;
  if (report) {
    out.reports = {*report};
    out.remarks = {report->notes, report->warnings};
    out.json = to_json(*report);
  }
  out.json["thread_length_m"] = braid.thread_length;
  out.json["turns"] = braid.turns;
  out.json["shortest_length_m"] = actuator::shortest_length(braid);
  prints(out, put_braid);
  Provenance provenance;
  const actuator::Actuator a = actuator_of(braid, name, source, report, provenance);
  out.files = {file_with(actuator_file(a, provenance))};
  return out;
}

// Computes the braid from counted trapezoids.
GeometryFound count_geometry(const GeometrySettings& settings, double side) {
  std::vector<double> counts;
  for (const std::string& piece : config::at_commas(settings.trapezoids))
    counts.push_back(config::quantity_setting(
        "trapezoids", piece, "1", units::atmosphere,
        {1, 1e5, "at least one each way, and no more than can be counted"}));
  if (counts.size() != 2)
    config::fail({"trapezoids", 0, 0}, "", config::in_quotes(settings.trapezoids),
                 "two counts, lengthwise and around: 37,16");
  const actuator::Braid braid = actuator::braid_from_trapezoids(counts[0], counts[1], side);
  const std::string source =
      fmt::format("{} x {} trapezoids of {}, [17], [18]", counts[0], counts[1], settings.side);
  return found_of(braid, nullptr, settings.name, source);
}

}  // namespace

GeometryFound find(const SourceList& sources, const GeometrySettings& settings) {
  const SettingValues values(settings);
  if (!settings.trapezoids.empty()) {
    if (!sources.empty())
      config::fail({"data", 0, 0}, "", "a file together with trapezoids",
                   "either a file of lengths and diameters, or trapezoids");
    if (settings.side.empty())
      config::fail({"side", 0, 0}, "", "nothing", "the side of one trapezoid, with trapezoids");
    return count_geometry(settings, values.of(settings.side));
  }
  const Source& source = only_of(sources);
  const GeometryResult found =
      identify_geometry(each_row_once(read_measured(source, geometry_columns())),
                        values.of(settings.thread_thickness));
  return found_of(found.braid, &found.report, settings.name,
                  "sinew identify geometry " + source.path);
}

}  // namespace sinew::identify
