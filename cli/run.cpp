// cli/run.cpp - `sinew run`: an experiment from its file to a folder with its log and its numbers.
#include "cli/run.h"

#include <charconv>
#include <cmath>
#include <optional>

#include "cli/emergency.h"
#include "cli/interrupt.h"
#include "sinew/config/diagnostics.h"
#include "sinew/run/folder/kept_run.h"
#include "sinew/run/folder/runnable.h"

namespace sinew::cli {

namespace {

// The run itself, with its log where there is one.
run::Outcome run_logged(const RunOptions& options, run::KeptRun& kept, Interrupt& interrupt) {
  std::atomic<std::int64_t> tick{0};
  run::RunOptions run_options{.pace = options.pace, .progress = &tick, .stop = &interrupt.asked()};
  kept.apply(run_options);
  std::optional<SpaceBar> space_bar;
  if (run::is_elsewhere(options.run.port)) space_bar.emplace([&] { interrupt.ask(); });
  if (space_bar && space_bar->listens() && !options.quiet)
    fmt::print(stderr, "the space bar stops the machine\n");
  const ProgressBar bar(tick, experiment::last_tick(kept.experiment()),
                        Steps{signals::tick_seconds, "s", 1}, options.quiet);
  return run::run(kept.experiment(), run_options);
}

ExitCode run_experiment(const RunOptions& options) {
  const Messages messages(options.quiet);
  if (options.pace > 0 && run::keeps_its_own_time(options.run.port))
    config::fail({options.run.experiment, 0, 0}, "--pace", fmt::format("{}", options.pace),
                 "no pace: the machine keeps its own time");
  // From before a board is there until it rests.
  Interrupt interrupt(run::is_elsewhere(options.run.port) ? Interrupt::Of::machine
                                                          : Interrupt::Of::work);
  run::RunRequest request = options.run;
  request.stop = &interrupt.asked();
  run::KeptRun kept(request, messages.notices());
  tell(kept.keep(run_logged(options, kept, interrupt)), options, messages);
  return ok;
}

}  // namespace

// CLI11's own words for it name the largest double there is. Slower than that no clock can wait.
std::string a_pace(const std::string& text) {
  constexpr double slowest = 1e-3;
  double value = -1;
  const char* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  const bool number = error == std::errc{} && end == last && std::isfinite(value);
  if (number && (value == 0 || value >= slowest)) return "";
  return fmt::format("found \"{}\"; expected 0, or a number from {} on", text, slowest);
}

void add_run_options(CLI::App& sub, const std::string& port, RunOptions& options) {
  run::RunRequest& request = options.run;
  sub.add_option(port, request.port,
                 "where it runs: simulated, serial:DEVICE[@RATE], emulated:FILE, lock-step:FILE or "
                 "comedi:DEVICE")
      ->transform(passes(run::problem_of_place));
  sub.add_flag("--clear-fault", request.clear_fault,
               "a board that dumped by itself, or whose watchdog has bitten, was looked into");
  sub.add_option("-o,--output", request.folder, "folder; else runs/<experiment>/<n>, counting up");
  sub.add_flag("--force", request.force, "replace the run that is in the folder");
  add_sets(sub, request.sets);
  sub.add_flag("--allow-unreachable", request.allow_unreachable,
               "aim at the nearest point where the foot path is out of reach");
  sub.add_flag("!--no-report", request.report, "leave report.html out");
  add_units(sub, request.units, "of what is printed and of the page; --json is in SI");
  sub.add_flag("--json", options.json, "print summary.json");
  sub.add_flag("--quiet", options.quiet, "only errors on stderr");
}

void add_run(CLI::App& app, Action& action) {
  auto options = std::make_shared<RunOptions>();
  CLI::App& sub = subcommand(app, "run", "an experiment; its log and numbers go into a new folder",
                             "sinew run experiments/walk-test-1.toml --set \"trolley.drag=0 lbf\"");
  sub.add_option("EXPERIMENT", options->run.experiment, "file of the experiment")->required();
  add_run_options(sub, "--port", *options);
  sub.add_option("--pace", options->pace, "simulated seconds per second of wall time; 0: no limit")
      ->transform(passes(a_pace));
  sub.callback([=, &action] { action = [=] { return run_experiment(*options); }; });
}

}  // namespace sinew::cli
