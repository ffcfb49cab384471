#include "sinew/run/folder/run_storage.h"

#include <algorithm>

#include <fmt/format.h>

#include "sinew/analysis/state_hash.h"
#include "sinew/analysis/warnings.h"
#include "sinew/config/compose.h"
#include "sinew/experiment/measured.h"
#include "sinew/run/folder/imported_run.h"
#include "sinew/run/folder/page.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/run/simulation/remote_boards.h"

namespace sinew::run {

namespace {

namespace fs = std::filesystem;

experiment::Experiment load(const RunRequest& request, const Notices& notices) {
  experiment::Experiment e = runnable(request.experiment, request.sets, request.allow_unreachable);
  for (const config::Problem& warning : e.warnings) notices.warning(config::to_text(warning));
  return e;
}

std::string summary_json(const analysis::Summary& summary, const experiment::Experiment& e,
                         const Place& place, const run::Outcome& outcome) {
  const double factor = outcome.wall > 0 ? outcome.duration / outcome.wall : 0;
  return to_json(summary, {.numbers = {{"real_time_factor", factor}, {"threads", 1}},
                           .board = place.who(),
                           .warnings = warnings_outside_log(e, outcome)});
}

}  // namespace

RunStorage::RunStorage(RunRequest request, Notices notices)
    : request_(std::move(request)),
      notices_(std::move(notices)),
      experiment_(load(request_, notices_)),
      logged_(run::logged_topics(experiment_)),
      place_(std::make_unique<Place>(request_.port, experiment_)) {
  place_->prepare(request_.clear_fault, request_.stop);
  if (!place_->who().empty()) notices_.note("board: " + place_->who());
  for (const std::string& line : place_->messages()) notices_.note(line);
  resolve();
  request_.inputs.emplace_back(request_.experiment);
  folder_.emplace(run_folder(request_.folder, request_.force, experiment_.name, request_.inputs));
  if (!experiment_.log.enabled) return;
  write_into(*folder_, resolved_name, resolved_);
  log_.emplace(folder_->work() / log_name, experiment_.name, experiment_.seed, resolved_, logged_);
}

void RunStorage::apply(RunOptions& options) {
  place_->apply(options);
  if (request_.stop != nullptr) options.stop = request_.stop;
  if (log_) log_->tap(options);
}

// The figures are calculated from the text that `analyze` will read, so that both agree bit for
// bit.
void RunStorage::resolve() {
  resolved_ = experiment::resolved(experiment_, SINEW_VERSION);
  values_ = config::parse_text(resolved_, std::string(resolved_name));
}

// Adds steered changes to resolved.toml as part of the run, with their source.
void RunStorage::finish_log(const run::Outcome& outcome) {
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
  resolve();
  if (!log_) return;
  write_into(*folder_, resolved_name, resolved_);
  log_->finish(resolved_, ended);
}

// Writes the summary of a run that its supervisor ended. An unfinished run has no other results.
void RunStorage::store_trip(const analysis::Analysis& a, const run::Outcome& outcome) {
  if (outcome.supervised.trip.cause == control::Trip::Cause::none) return;
  write_into(*folder_, summary_name, summary_json(a.summary, experiment_, *place_, outcome));
}

// Writes the board's own record of its fault, since the line may have lost telemetry. Returns the
// place of the file.
std::string RunStorage::store_fault_log() try {
  plant::RemoteBoard* board = place_->board();
  const bool there = board != nullptr && board->why() != plant::RemoteBoard::Why::closed;
  if (!there) return "";
  const std::vector<link::Telemetry> log = board->fault_log();
  if (log.empty()) return "";
  write_into(*folder_, fault_log_name, fault_log_csv(log, experiment_));
  return fmt::format("\nthe board's own log of its last {} ms: {}", 10 * log.size(),
                     (folder_->work() / fault_log_name).string());
} catch (const plant::BoardError& e) {
  notices_.warning(e.what());
  return "";
}

// Leaves the log without an index, as one that was cut off, and throws with its name.
void RunStorage::break_off(const run::Outcome& outcome) {
  const bool logged = log_.has_value();
  log_.reset();
  throw std::runtime_error(
      fmt::format("{}: interrupted at {:.2f} s of the run; {}", experiment_.path, outcome.duration,
                  logged ? fmt::format("its log, which reads as cut off, is {}",
                                       (folder_->work() / log_name).string())
                         : "it keeps no log"));
}

// Writes the page from the logged channels, which may be a part of the recorded ones.
bool RunStorage::write_page(const analysis::Analysis& of_all, run::Outcome& outcome) {
  if (!log_ || !request_.report) return false;
  const auto write = [&](const analysis::Analysis& logged) {
    return write_report(*folder_, logged, values_, experiment_.name, notices_, request_.units);
  };
  if (is_whole(logged_)) return write(of_all);
  const signals::Table part = run::logged_part(std::move(outcome.table), logged_);
  return write(analysis::Analysis(part, of_all.machine));
}

// Returns the hash of the channels that the log has, as `sinew analyze` computes it from the log;
// empty without true values, as for a log of hardware.
std::string RunStorage::hash_of_log(const signals::Table& table) const {
  if (std::ranges::none_of(logged_.topics, [](const signals::Topic& topic) {
        return topic.name.starts_with("/true/");
      }))
    return "";
  return analysis::state_hash(table, [&](const std::string& name) {
    return std::ranges::find(logged_.topics, name, &signals::Topic::name) != logged_.topics.end();
  });
}

StoredRun RunStorage::store_files(run::Outcome& outcome, analysis::Machine machine) {
  const analysis::Analysis a(outcome.table, std::move(machine));
  StoredRun kept{.folder = folder(),
                 .summary = a.summary,
                 .machine = a.machine,
                 .duration = outcome.duration,
                 .wall = outcome.wall};
  if (experiment_.stand)
    if (const std::string measured = experiment::measured_csv(experiment_, outcome.table);
        !measured.empty())
      write_into(*folder_, measured_name, measured);
  if (log_ && !is_whole(logged_) && !kept.summary.state_hash.empty())
    kept.summary.state_hash = hash_of_log(outcome.table);
  warn(kept.summary.warnings, outcome);
  kept.json = summary_json(kept.summary, experiment_, *place_, outcome);
  write_into(*folder_, summary_name, kept.json);
  kept.page = write_page(a, outcome);
  commit_run(*folder_);
  return kept;
}

void RunStorage::warn(const std::vector<std::string>& of_the_log,
                      const run::Outcome& outcome) const {
  for (const std::string& text : of_the_log) notices_.warning(text);
  for (const std::string& text : warnings_outside_log(experiment_, outcome)) notices_.warning(text);
}

StoredRun RunStorage::store(run::Outcome outcome) try {
  if (outcome.stopped) break_off(outcome);
  finish_log(outcome);
  analysis::Machine machine = analysis::read_machine(values_);
  if (outcome.ended_early()) {
    const analysis::Analysis a(outcome.table, std::move(machine), cause_of(experiment_, outcome));
    warn(analysis::texts(a.warnings), outcome);
    store_trip(a, outcome);
    throw std::runtime_error(last_records(experiment_, outcome) + store_fault_log());
  }
  return store_files(outcome, std::move(machine));
} catch (const std::exception& e) {
  throw std::runtime_error(e.what() + where_left(*folder_));
}

StoredRun run_and_store(RunRequest request, Notices notices) {
  RunStorage kept(std::move(request), std::move(notices));
  run::RunOptions options;
  kept.apply(options);
  return kept.store(run::run(kept.experiment(), options));
}

StoredRun store_table(const signals::Table& table, const experiment::Experiment& e,
                      const RunRequest& where, const Notices& notices) {
  return store_imported(table, e, {}, "", where, notices);
}

void refuse_unrunnable(const experiment::Experiment& e, bool allow_unreachable) {
  if (!allow_unreachable) refuse_unreachable(e);
  (void)logged_topics(e);
}

experiment::Experiment runnable(const std::string& path, const std::vector<std::string>& sets,
                                bool allow_unreachable) {
  const config::Node root = config::compose(path, sets);
  experiment::Experiment e = buildable(root, path);
  refuse_unrunnable(e, allow_unreachable);
  (void)analysis::read_machine(root);  // an experiment that cannot be summarised is not run
  return e;
}

}  // namespace sinew::run
