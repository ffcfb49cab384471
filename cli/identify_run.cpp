// cli/identify_run.cpp - `sinew identify run`: friction, damping, dead times, volumes and leaks of
// a robot from a run of it.
#include <fmt/format.h>

#include "cli/identify.h"
#include "cli/terminal.h"
#include "sinew/config/diagnostics.h"
#include "sinew/identify/task/run_task.h"

namespace sinew::cli {

namespace {

struct IdentifyRunOptions {
  DataOptions data;
  ResultOptions result;
  identify::RunFitSettings settings;
};

ExitCode run_run(const IdentifyRunOptions& options) {
  check_result_options(options.result);
  identify::RunFitSettings settings = options.settings;
  if (!settings.base.empty() && options.result.out.empty())
    config::fail({"--base", 0, 0}, "", "no --out", "a file in which to name the base");
  const Messages messages(options.result.quiet);
  settings.progress = [&](const std::string& what) { messages.note(what); };
  const identify::RunFitFound found = identify::find_run_fit(settings);
  DataOptions data = options.data;
  data.files = {settings.run};
  tell(found.result.report, found.file(options.result.out), data, options.result, to_json(found));
  return ok;
}

}  // namespace

void add_identify_run(Command identify, Action& action) {
  auto options = std::make_shared<IdentifyRunOptions>();
  identify::RunFitSettings& o = options->settings;
  Command sub = identify.subcommand(
      "run", "friction, damping, dead times, volumes, leaks from a run of a robot itself",
      "sinew run experiments/one-joint.toml -o runs/bench\n"
      "  sinew identify run runs/bench --base robots/one-joint/robot.toml -o mine.toml\n"
      "  sinew identify run runs/bench --fit friction,valve.inlet.closing_delay --hold-out \"30 "
      "%\"");
  sub.add_option("RUN", o.run, "a run's folder, or a log file; an imported recording's too")
      .required();
  sub.add_option(
         "--fit", o.fit,
         "keys, and groups of them: friction, damping, dead-time, volume, leak; absent: all "
         "groups")
      .takes_one()
      .split_at(',');
  sub.add_option("--machine", o.machine, "what was run, in place of the folder's");
  sub.add_option("--start,--set", o.sets,
                 "KEY=VALUE: where the search begins, or what is known; may be repeated")
      .takes_one();
  sub.add_option("--prior", o.priors,
                 "\"KEY=VALUE +- DEVIATION\": what is known of a fitted number; may be repeated")
      .takes_one();
  sub.add_option("--freeze", o.freeze,
                 "KEY=VALUE: a number that is known and not fitted; may be repeated")
      .takes_one();
  sub.add_option("--hold-out", o.hold_out, "of the run, at its end: scores and is not fitted")
      .show_default();
  sub.add_option("--from", o.from, "what is before is not compared").show_default();
  sub.add_option("--threads", o.threads, "simulations at once; 0: one for each processor")
      .is_between(0, 1024)
      .show_default();
  sub.add_option("--base", o.base, "the robot's file, named in the one of --out");
  add_result_options(sub, options->result);
  sub.callback([options, &action] { action = [options] { return run_run(*options); }; });
}

}  // namespace sinew::cli
