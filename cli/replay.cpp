// cli/replay.cpp - `sinew replay`: recorded readings through today's controller; does it decide the
// same valve edges?
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/json_text.h"
#include "cli/terminal.h"
#include "sinew/analysis/measures/edges.h"
#include "sinew/log/reader.h"
#include "sinew/run/folder/run_folder.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/run/simulation/run.h"

namespace sinew::cli {

namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::string run, machine;
  bool json = false, quiet = false;
};

void print(const analysis::EdgeComparison& c, bool json) {
  if (json) {
    Json out{{"recorded_edges", c.recorded}, {"replayed_edges", c.replayed}, {"equal", !c.first}};
    if (c.first)
      out["first_difference"] = {{"time_s", 1e-9 * static_cast<double>(c.first->time_ns)},
                                 {"topic", c.first->topic},
                                 {"recorded", c.first->recorded},
                                 {"replayed", c.first->replayed}};
    fmt::print("{}\n", json_text(out, 2));
  } else if (!c.first) {
    fmt::print("{} edges, all equal\n", c.recorded);
  } else {
    fmt::print("{} edges recorded, {} replayed\n", c.recorded, c.replayed);
    fmt::print("first difference at {:.4f} s: {} {} in the log, {} in the replay\n",
               1e-9 * static_cast<double>(c.first->time_ns), c.first->topic, c.first->recorded,
               c.first->replayed);
  }
}

ExitCode replay_run(const Options& options) {
  const Messages messages(options.quiet);
  const run::RecordedRun run = run::recorded_run(options.run);
  const auto experiment = run::buildable(run::machine_of(run, options.machine).string());
  const signals::Table recorded = log::read(run.log);
  if (!recorded.complete)
    messages.warning(run.log.string() + " was cut off; compared as far as it goes");

  const run::Outcome outcome = run::replay(experiment, recorded);
  const analysis::EdgeComparison comparison = analysis::compare_edges(recorded, outcome.table);
  print(comparison, options.json);
  return comparison.first ? failed : ok;
}

}  // namespace

void add_replay(Command app, Action& action) {
  auto options = std::make_shared<Options>();
  Command sub = app.subcommand("replay", "recorded readings through today's controller",
                               "sinew replay runs/walk-test-1/1");
  sub.add_option("DIR", options->run, "a run's folder, or a log file").required();
  sub.add_option("--machine", options->machine, "what was run, in place of the folder's");
  sub.add_flag("--json", options->json, "as JSON");
  sub.add_flag("--quiet", options->quiet, "only errors on stderr");
  sub.callback([=, &action] { action = [=] { return replay_run(*options); }; });
}

}  // namespace sinew::cli
