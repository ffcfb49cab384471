// cli/identify_geometry.cpp - `sinew identify geometry`: thread length and turns of a braid.
#include <fmt/format.h>

#include <cmath>

#include "cli/arguments.h"
#include "cli/identify.h"
#include "cli/json_text.h"
#include "sinew/actuator/braid.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/quantity.h"
#include "sinew/identify/actuator/geometry.h"
#include "sinew/identify/actuator/geometry_file.h"

namespace sinew::cli {

namespace {

struct Options {
  DataOptions data;
  ResultOptions result;
  std::string name = "bpa", trapezoids, side, thread = "0 mm";
};

constexpr Range thickness = from_zero(0.1, "of one thread");

ExitCode from_pairs(const Options& options) {
  const std::vector<identify::Source> sources = sources_of(options.data);
  if (sources.size() != 1)
    config::fail({"data", 0, 0}, "", fmt::format("{} files", sources.size()), "one");
  const double thread =
      argument("--thread-thickness", options.thread, "m", units::atmosphere, thickness);
  const identify::GeometryResult found = identify::identify_geometry(
      identify::read_measured(sources[0], identify::geometry_columns()), thread);

  tell(found.report,
       identify::braid_file(found.braid, options.name, "sinew identify geometry " + sources[0].path,
                            &found.report),
       options.data, options.result, identify::describe(found.braid));
  return ok;
}

ExitCode from_trapezoids(const Options& options) {
  const std::vector<double> counts =
      argument_list("--trapezoids", options.trapezoids, "1",
                    {1, 1e5, "at least one each way, and no more than can be counted"});
  if (counts.size() != 2)
    config::fail({"--trapezoids", 0, 0}, "", config::in_quotes(options.trapezoids),
                 "two counts, lengthwise and around: 37,16");
  const double side = argument("--side", options.side, "m", units::atmosphere,
                               above_zero(1, "of one trapezoid between two threads"));
  (void)argument("--thread-thickness", options.thread, "m", units::atmosphere, thickness);
  const actuator::Braid braid = actuator::braid_from_trapezoids(counts[0], counts[1], side);

  if (options.result.json) {
    fmt::print("{}\n", json_text(identify::describe(braid), 2));
  } else {
    fmt::print("thread_length  {}  [17]\nturns          {}  [18]\nshortest       {}  [5], [6]\n",
               config::format_quantity(braid.thread_length, "m", "mm"),
               config::format_number(braid.turns),
               config::format_quantity(actuator::shortest_length(braid), "m", "mm"));
  }
  const std::string source =
      fmt::format("{} x {} trapezoids of {}, [17], [18]", counts[0], counts[1], options.side);
  write_parameter_file(identify::braid_file(braid, options.name, source), options.result);
  return ok;
}

}  // namespace

void add_identify_geometry(Command identify, Action& action) {
  auto options = std::make_shared<Options>();
  Command sub = identify.subcommand(
      "geometry", "thread length and turns, from counted trapezoids or from lengths and diameters",
      "sinew identify geometry --trapezoids 37,16 --side \"0.057 in\"");
  add_data_options(sub, options->data);
  sub.option("data").required(false);
  sub.add_option("--trapezoids", options->trapezoids,
                 "LENGTHWISE,AROUND counted on the opened mesh, instead of data");
  sub.add_option("--side", options->side, "of one trapezoid");
  sub.add_option("--thread-thickness", options->thread,
                 "taken off diameters that were measured outside the threads")
      .show_default();
  sub.add_option("--name", options->name, "of the actuator").show_default();
  add_result_options(sub, options->result);
  sub.callback([options, &action] {
    if (options->data.files.empty() == options->trapezoids.empty())
      refuse("data", "either a file of lengths and diameters, or --trapezoids");
    if (!options->trapezoids.empty() && !options->result.report.empty())
      refuse("--report", "needs a file of lengths and diameters to show");
    if (!options->trapezoids.empty() && options->side.empty())
      refuse("--side", "is needed with --trapezoids");
    action = [options] {
      check_result_options(options->result);
      return options->trapezoids.empty() ? from_pairs(*options) : from_trapezoids(*options);
    };
  });
}

}  // namespace sinew::cli
