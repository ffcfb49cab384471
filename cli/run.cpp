// cli/run.cpp - `sinew run`: an experiment from its file to a folder with its log and its numbers.
#include "sinew/experiment/run.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>

#include "cli/command.h"
#include "cli/page.h"
#include "cli/report.h"
#include "cli/run_folder.h"
#include "cli/run_log.h"
#include "cli/run_rig.h"
#include "cli/terminal.h"
#include "sinew/config/node.h"

namespace sinew::cli {

namespace {

namespace fs = std::filesystem;

struct Options {
  std::string experiment, folder;
  std::vector<std::string> sets;
  double pace = 0;
  bool force = false, allow_unreachable = false, report = true, json = false, quiet = false;
};

experiment::Experiment load(const Options& options, const Messages& messages) {
  experiment::Experiment e = experiment::load(options.experiment, options.sets);
  if (!options.allow_unreachable) refuse_unreachable(e);
  for (const config::Problem& warning : e.warnings) messages.warning(config::to_text(warning));
  return e;
}

fs::path folder_for(const Options& options, const experiment::Experiment& e) {
  return options.folder.empty() ? next_run_folder(e.name)
                                : chosen_run_folder(options.folder, options.force);
}

// The run itself, with its log where there is one.
experiment::Outcome run_logged(const Options& options, const experiment::Experiment& e,
                               RunLog* log) {
  std::atomic<std::int64_t> tick{0};
  experiment::RunOptions run_options{.pace = options.pace, .progress = &tick};
  if (log) log->tap(run_options);

  std::optional<ProgressBar> bar(std::in_place, tick, experiment::last_tick(e),
                                 Steps{signals::tick_seconds, "s", 1}, options.quiet);
  experiment::Outcome outcome = experiment::run(e, run_options);
  bar.reset();
  if (log) log->finish();
  return outcome;
}

std::string summary_json(const analysis::Summary& summary, const experiment::Outcome& outcome) {
  const double factor = outcome.wall > 0 ? outcome.duration / outcome.wall : 0;
  return to_json(summary, {{"real_time_factor", factor}, {"threads", 1}});
}

bool ended_early(const experiment::Outcome& outcome) {
  return outcome.status != signals::Status::ok || outcome.seen.fault != signals::Status::ok;
}

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

// What a stand has no use for.
ExitCode run_on_stand(const Options& o) {
  if (o.pace > 0)
    config::fail({o.experiment, 0, 0}, "--pace", fmt::format("{}", o.pace),
                 "a run as fast as it goes: a stand has no live log");
  return run_rig({o.experiment, o.folder, o.sets, o.force, o.report, o.json, o.quiet});
}

ExitCode run_experiment(const Options& options) {
  if (is_rig(options.experiment)) return run_on_stand(options);
  const Messages messages(options.quiet);
  const experiment::Experiment e = load(options, messages);
  const std::string resolved = experiment::resolved(e, SINEW_VERSION);
  // As `analyze` will read it: so both come to the same bits.
  const analysis::Machine machine =
      analysis::read_machine(config::parse_text(resolved, std::string(resolved_name)));

  const LoggedTopics logged = logged_topics(e);

  const fs::path folder = folder_for(options, e);
  std::optional<RunLog> log;
  if (e.log.enabled) {
    write_file(folder / resolved_name, resolved);
    log.emplace(folder / log_name, e.name, e.seed, resolved, logged);
  }
  experiment::Outcome outcome = run_logged(options, e, log ? &*log : nullptr);
  warn_of(e, outcome, messages);
  if (ended_early(outcome)) throw std::runtime_error(black_box(e, outcome));

  const analysis::Summary summary = analysis::summarize(outcome.table, machine);
  const std::string json = summary_json(summary, outcome);
  write_file(folder / summary_name, json);
  if (log && options.report)
    write_report(folder, logged_part(std::move(outcome.table), logged), resolved, e.name, messages);

  if (options.json) {
    fmt::print("{}", json);
    messages.note(folder.string());
    return ok;
  }
  print_verdicts(summary, machine);
  messages.note(fmt::format("{:.2f} s in {:.3f} s, kept in {}", outcome.duration, outcome.wall,
                            folder.string()));
  return ok;
}

}  // namespace

void add_run(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App& sub = subcommand(app, "run", "an experiment; its log and numbers go into a new folder",
                             "sinew run experiments/walk-test-1.toml --set \"trolley.drag=0 lbf\"");
  sub.add_option("EXPERIMENT", options->experiment, "file of the experiment")->required();
  sub.add_option("-o,--output", options->folder, "folder; else runs/<experiment>/<n>, counting up");
  sub.add_flag("--force", options->force, "replace the run that is in the folder");
  add_sets(sub, options->sets);
  sub.add_option("--pace", options->pace, "simulated seconds per second of wall time; 0: no limit")
      ->check(a_pace, "");
  sub.add_flag("--allow-unreachable", options->allow_unreachable,
               "aim at the nearest point where the foot path is out of reach");
  sub.add_flag("!--no-report", options->report, "leave report.html out");
  sub.add_flag("--json", options->json, "print summary.json");
  sub.add_flag("--quiet", options->quiet, "only errors on stderr");
  sub.callback([=, &action] { action = [=] { return run_experiment(*options); }; });
}

}  // namespace sinew::cli
