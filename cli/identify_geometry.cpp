// cli/identify_geometry.cpp - `sinew identify geometry`: thread length and turns of a braid.
#include <fmt/format.h>

#include "cli/identify.h"
#include "cli/units.h"
#include "sinew/actuator/braid.h"
#include "sinew/config/quantity.h"
#include "sinew/identify/task/geometry_task.h"

namespace sinew::cli {

namespace {

struct IdentifyGeometryOptions {
  DataOptions data;
  ResultOptions result;
  identify::GeometrySettings settings;
};

ExitCode from_pairs(const IdentifyGeometryOptions& options) {
  const auto found = identify::find_geometry(sources_of(options.data), options.settings);
  tell(*found.report, found.file, options.data, options.result, to_json(found));
  return ok;
}

ExitCode from_trapezoids(const IdentifyGeometryOptions& options) {
  const auto found = identify::count_geometry(options.settings);
  write_parameter_file(found.file, options.result);
  if (options.result.json) {
    fmt::print("{}\n", to_json(found).text(2));
  } else {
    const config::UnitsToShow asked = units_asked(options.result.units, units::UnitSet::si);
    const std::string unit = asked.asked ? asked.units.of("m").name : "mm";
    fmt::print("thread_length  {}  [17]\nturns          {}  [18]\nshortest       {}  [5], [6]\n",
               config::format_quantity(found.braid.thread_length, "m", unit),
               config::format_number(found.braid.turns),
               config::format_quantity(actuator::shortest_length(found.braid), "m", unit));
  }
  return ok;
}

}  // namespace

void add_identify_geometry(Command identify, Action& action) {
  auto options = std::make_shared<IdentifyGeometryOptions>();
  Command sub = identify.subcommand(
      "geometry", "thread length and turns, from counted trapezoids or from lengths and diameters",
      "sinew identify geometry --trapezoids 37,16 --side \"0.057 in\"");
  add_data_options(sub, options->data);
  sub.option("DATA").required(false);
  sub.add_option("--trapezoids", options->settings.trapezoids,
                 "LENGTHWISE,AROUND counted on the opened mesh, instead of data");
  sub.add_option("--side", options->settings.side, "of one trapezoid");
  sub.add_option("--thread-thickness", options->settings.thread_thickness,
                 "taken off diameters that were measured outside the threads")
      .show_default();
  sub.add_option("--name", options->settings.name, "of the actuator").show_default();
  add_result_options(sub, options->result);
  sub.callback([options, &action] {
    if (options->data.files.empty() == options->settings.trapezoids.empty())
      refuse("DATA", options->data.files.empty() ? "no file" : "a file beside --trapezoids",
             "either a file of lengths and diameters, or --trapezoids");
    if (!options->settings.trapezoids.empty() && !options->result.report.empty())
      refuse("--report", "--trapezoids beside it", "a file of lengths and diameters, to show it");
    if (!options->settings.trapezoids.empty() && options->settings.side.empty())
      require("--side", "the side of one trapezoid, beside --trapezoids");
    action = [options] {
      check_result_options(options->result);
      return options->settings.trapezoids.empty() ? from_pairs(*options)
                                                  : from_trapezoids(*options);
    };
  });
}

}  // namespace sinew::cli
