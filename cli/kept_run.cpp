#include "cli/kept_run.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "cli/page.h"
#include "cli/report.h"
#include "cli/run_folder.h"
#include "cli/runnable.h"
#include "sinew/analysis/warnings.h"
#include "sinew/config/node.h"

namespace sinew::cli {

namespace {

namespace fs = std::filesystem;

experiment::Experiment load(const RunRequest& request, const Messages& messages) {
  experiment::Experiment e = runnable(request.experiment, request.sets, request.allow_unreachable);
  for (const config::Problem& warning : e.warnings) messages.warning(config::to_text(warning));
  return e;
}

// As `analyze` will read it: so both come to the same bits.
analysis::Machine machine_in(const std::string& resolved) {
  return analysis::read_machine(config::parse_text(resolved, std::string(resolved_name)));
}

std::string summary_json(const analysis::Summary& summary, const experiment::Experiment& e,
                         const experiment::Outcome& outcome) {
  const double factor = outcome.wall > 0 ? outcome.duration / outcome.wall : 0;
  return to_json(summary, {.numbers = {{"real_time_factor", factor}, {"threads", 1}},
                           .warnings = warnings_beside_the_log(e, outcome)});
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

void add_run_options(CLI::App& sub, RunRequest& request) {
  sub.add_option("-o,--output", request.folder, "folder; else runs/<experiment>/<n>, counting up");
  sub.add_flag("--force", request.force, "replace the run that is in the folder");
  add_sets(sub, request.sets);
  sub.add_flag("--allow-unreachable", request.allow_unreachable,
               "aim at the nearest point where the foot path is out of reach");
  sub.add_flag("!--no-report", request.report, "leave report.html out");
  sub.add_flag("--json", request.json, "print summary.json");
  sub.add_flag("--quiet", request.quiet, "only errors on stderr");
}

KeptRun::KeptRun(RunRequest request, const Messages& messages)
    : request_(std::move(request)),
      messages_(messages),
      experiment_(load(request_, messages)),
      resolved_(experiment::resolved(experiment_, SINEW_VERSION)),
      logged_(experiment::logged_topics(experiment_)) {
  folder_.emplace(run_folder(request_.folder, request_.force, experiment_.name));
  if (!experiment_.log.enabled) return;
  write_into(*folder_, resolved_name, resolved_);
  log_.emplace(folder_->work() / log_name, experiment_.name, experiment_.seed, resolved_, logged_);
}

// What was steered is a part of what was run, with where it comes from.
void KeptRun::finish_log(const experiment::Outcome& outcome) {
  const std::size_t written = experiment_.plan.changes.size();
  const std::string ended = outcome.ended_early() ? cause_of(experiment_, outcome) : "";
  if (outcome.changes.size() == written) {
    if (log_) log_->finish(resolved_, ended);
    return;
  }
  experiment_.plan.changes = outcome.changes;
  for (std::size_t i = written; i < outcome.changes.size(); ++i)
    for (const char* key : {"time", "value"})
      experiment_.origins.push_back(
          {.path = fmt::format("change[{}].{}", i, key), .source = "set while it ran"});
  resolved_ = experiment::resolved(experiment_, SINEW_VERSION);
  if (!log_) return;
  write_into(*folder_, resolved_name, resolved_);
  log_->finish(resolved_, ended);
}

// Who the supervisor did not believe: no other figures of a run that was not finished.
void KeptRun::keep_trip(const experiment::Outcome& outcome) {
  if (outcome.supervised.trip.cause == control::Trip::Cause::none) return;
  const analysis::Summary summary = analysis::summarize_trip(outcome.table, machine_in(resolved_));
  write_into(*folder_, summary_name, summary_json(summary, experiment_, outcome));
}

// Leaves the log without an index, as one that was cut off, and throws with its name.
void KeptRun::break_off(const experiment::Outcome& outcome) {
  const bool logged = log_.has_value();
  log_.reset();
  throw std::runtime_error(
      fmt::format("{}: interrupted at {:.2f} s of the run; {}", experiment_.path, outcome.duration,
                  logged ? fmt::format("its log, which reads as cut off, is {}",
                                       (folder_->work() / log_name).string())
                         : "it keeps no log"));
}

KeptRun::Files KeptRun::keep_files(experiment::Outcome& outcome, const analysis::Machine& machine) {
  analysis::Summary summary = analysis::summarize(outcome.table, machine);
  warn(summary.warnings, outcome);
  const std::string json = summary_json(summary, experiment_, outcome);
  write_into(*folder_, summary_name, json);
  bool page = false;
  if (log_ && request_.report)
    page = write_report(*folder_, experiment::logged_part(std::move(outcome.table), logged_),
                        resolved_, experiment_.name, messages_);
  commit_run(*folder_);
  return {std::move(summary), json, page};
}

// Prints what summary.json has under `warnings` and `host.warnings`.
void KeptRun::warn(const std::vector<std::string>& of_the_log,
                   const experiment::Outcome& outcome) const {
  for (const std::string& text : of_the_log) messages_.warning(text);
  for (const std::string& text : warnings_beside_the_log(experiment_, outcome))
    messages_.warning(text);
}

ExitCode KeptRun::keep(experiment::Outcome outcome) try {
  if (outcome.stopped) break_off(outcome);
  finish_log(outcome);
  const analysis::Machine machine = machine_in(resolved_);
  if (outcome.ended_early()) {
    warn(analysis::texts(analysis::warnings(outcome.table, machine)), outcome);
    keep_trip(outcome);
    throw std::runtime_error(black_box(experiment_, outcome));
  }

  const Files files = keep_files(outcome, machine);
  if (request_.json) {
    fmt::print("{}", files.json);
    messages_.note(folder().string());
  } else {
    print_verdicts(files.summary, machine);
    messages_.note(fmt::format("{:.2f} s in {:.3f} s, kept in {}", outcome.duration, outcome.wall,
                               folder().string()));
  }
  if (files.page) note_report(*folder_, messages_);
  return ok;
} catch (const std::exception& e) {
  throw std::runtime_error(e.what() + where_left(*folder_));
}

}  // namespace sinew::cli
