// cli/show.cpp - `sinew show`: every value as it is used, and where it came from.
#include <fmt/format.h>

#include "cli/command.h"
#include "cli/option_groups.h"
#include "sinew/files/values.h"
#include "sinew/json/json.h"

namespace sinew::cli {

namespace {

struct ShowOptions {
  std::string file;
  std::vector<std::string> keys;
  std::vector<std::string> sets;
  std::string units;
  bool json = false;
};

ExitCode show(const ShowOptions& options) {
  const files::Values values = files::values(options.file, options.sets, options.keys);
  const config::UnitsToShow asked = chosen_units(options.units, units::UnitSet::si, &values.in_si);
  if (options.json)
    fmt::print("{}\n", Json::parse(files::json_of(values)).text(2));
  else
    fmt::print("{}", files::text_of(values, asked.asked ? &asked.units : nullptr));
  return ok;
}

}  // namespace

void add_show(CLI::App& app, Action& action) {
  auto options = std::make_shared<ShowOptions>();
  CLI::App& sub = subcommand(app, "show", "values of a file, and where each one came from",
                             "sinew show robots/leg/robot.toml joint.knee muscle.hip");
  sub.add_option("FILE", options->file, "experiment, rig, robot, actuator, valves or wiring file")
      ->required();
  sub.add_option("KEY", options->keys, "keys, or how they begin");
  add_sets(sub, options->sets);
  add_units(sub, options->units, "of the column beside what is written, else SI");
  sub.add_flag("--json", options->json, "as JSON");
  sub.callback([=, &action] { action = [=] { return show(*options); }; });
}

}  // namespace sinew::cli
