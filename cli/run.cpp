// cli/run.cpp - `sinew run`: an experiment from its file to a folder with its log and its numbers.
#include "sinew/experiment/run.h"

#include <fmt/format.h>

#include <optional>

#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/kept_run.h"
#include "cli/run_rig.h"
#include "cli/terminal.h"
#include "sinew/config/diagnostics.h"

namespace sinew::cli {

namespace {

// The run itself, with its log where there is one.
experiment::Outcome run_logged(double pace, bool quiet, const experiment::Experiment& e,
                               RunLog* log) {
  std::atomic<std::int64_t> tick{0};
  const Interrupt interrupt;
  experiment::RunOptions run_options{.pace = pace, .progress = &tick, .stop = &interrupt.asked()};
  if (log) log->tap(run_options);
  const ProgressBar bar(tick, experiment::last_tick(e), Steps{signals::tick_seconds, "s", 1},
                        quiet);
  return experiment::run(e, run_options);
}

// What a stand has no use for.
ExitCode run_on_stand(const RunRequest& o) {
  if (o.pace > 0)
    config::fail({o.experiment, 0, 0}, "--pace", fmt::format("{}", o.pace),
                 "a run as fast as it goes: a stand has no live log");
  return run_rig({o.experiment, o.folder, o.sets, o.force, o.report, o.json, o.quiet});
}

ExitCode run_experiment(const RunRequest& request) {
  if (is_rig(request.experiment)) return run_on_stand(request);
  const Messages messages(request.quiet);
  KeptRun kept(request, messages);
  return kept.keep(run_logged(request.pace, request.quiet, kept.experiment(), kept.log()));
}

}  // namespace

void add_run(CLI::App& app, Action& action) {
  auto request = std::make_shared<RunRequest>();
  CLI::App& sub = subcommand(app, "run", "an experiment; its log and numbers go into a new folder",
                             "sinew run experiments/walk-test-1.toml --set \"trolley.drag=0 lbf\"");
  sub.add_option("EXPERIMENT", request->experiment, "file of the experiment")->required();
  add_run_options(sub, *request);
  sub.add_option("--pace", request->pace, "simulated seconds per second of wall time; 0: no limit")
      ->check(a_pace, "");
  sub.callback([=, &action] { action = [=] { return run_experiment(*request); }; });
}

}  // namespace sinew::cli
