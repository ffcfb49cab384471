// cli/replay.cpp - `sinew replay`: recorded readings through today's controller, or recorded valves
// through today's plant; where do they part?
#include <fmt/format.h>

#include "cli/command.h"
#include "cli/option_groups.h"
#include "cli/terminal.h"
#include "sinew/run/folder/replayed.h"

namespace sinew::cli {

namespace {

struct ReplayOptions {
  run::ReplayRequest request;
  std::string of = "controller", folder, units;
  double band = 5;  // [%]
  bool json = false, quiet = false;
};

ExitCode replay_run(ReplayOptions options) {
  const Messages messages(options.quiet);
  options.request.of = options.of == "plant" ? run::ReplayOf::plant : run::ReplayOf::controller;
  options.request.band = 0.01 * options.band;
  if (!options.folder.empty()) options.request.folder = options.folder;
  const run::Replayed replayed = run::replay_run(options.request, messages.notices());
  if (options.json)
    fmt::print("{}", to_json(replayed));
  else
    fmt::print("{}", text_of(replayed, chosen_units(options.units, units::UnitSet::thesis).units,
                             width_of_output()));
  if (replayed.folder) messages.note(replayed.folder->string());
  // A plant that parts from a measurement is a result; a controller that does is a change.
  const bool bad =
      replayed.of == run::ReplayOf::controller ? !replayed.agrees() : !replayed.cause.empty();
  return bad ? failed : ok;
}

}  // namespace

void add_replay(CLI::App& app, Action& action) {
  auto options = std::make_shared<ReplayOptions>();
  CLI::App& sub = subcommand(app, "replay", "a recording through today's controller, or plant",
                             "sinew replay runs/walk-test-1/1 --of plant -o runs/replayed");
  sub.add_option("DIR", options->request.run, "a run's folder, or a log file")->required();
  sub.add_option("--of", options->of,
                 "controller: it is fed the readings; plant: it is fed the valves' commands")
      ->check(one_of({"controller", "plant"}));
  sub.add_option("--machine", options->request.machine, "what was run, in place of the folder's");
  add_sets(sub, options->request.sets);
  sub.add_option("--band", options->band,
                 "of a plant: has parted beyond this share of a channel's range, in %");
  sub.add_option("-o,--output", options->folder, "keep the replay in this folder, as a run");
  sub.add_flag("--force", options->request.force, "replace the run that is in the folder");
  add_units(sub, options->units, "of the table; --json is in SI");
  sub.add_flag("--json", options->json, "as JSON");
  sub.add_flag("--quiet", options->quiet, "only errors on stderr");
  sub.callback([=, &action] { action = [=] { return replay_run(*options); }; });
}

}  // namespace sinew::cli
