// cli/kept_run.h - a run and the folder that keeps it: what `sinew run` and `sinew view --live` do
// before the loop, and after it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/run_folder.h"
#include "cli/run_log.h"
#include "cli/terminal.h"
#include "sinew/analysis/machine.h"
#include "sinew/analysis/summary.h"
#include "sinew/experiment/run.h"

namespace sinew::cli {

struct RunRequest {
  std::string experiment, folder;
  std::vector<std::string> sets;
  double pace = 0;
  bool force = false, allow_unreachable = false, report = true, json = false, quiet = false;
};

// EXPERIMENT, -o, --force, --set, --allow-unreachable, --no-report, --json, --quiet.
void add_run_options(CLI::App& sub, RunRequest& request);

// Of --pace: "", or what is wrong.
std::string a_pace(const std::string& text);

class KeptRun {
 public:
  // Loads the experiment and opens its folder and its log. Throws config::Error for what cannot be
  // run, or kept.
  KeptRun(RunRequest request, const Messages& messages);

  const experiment::Experiment& experiment() const { return experiment_; }
  const std::string& resolved() const { return resolved_; }
  const std::filesystem::path& folder() const { return folder_->path(); }
  RunLog* log() { return log_ ? &*log_ : nullptr; }

  // After the loop: the log's end, summary and page into the folder, verdicts to stdout. What was
  // changed on the way stands in resolved.toml. Only then it takes the place of an older run.
  // Throws where the run ended early, with its last records, and where it was stopped: then its log
  // reads as cut off.
  ExitCode keep(experiment::Outcome outcome);

 private:
  void finish_log(const experiment::Outcome& outcome);
  [[noreturn]] void break_off(const experiment::Outcome& outcome);
  struct Files {
    analysis::Summary summary;
    std::string json;   // summary.json
    bool page = false;  // there is a report.html
  };
  Files keep_files(experiment::Outcome& outcome, const analysis::Machine& machine);
  void warn(const std::vector<std::string>& of_the_log, const experiment::Outcome& outcome) const;
  void keep_trip(const experiment::Outcome& outcome);

  RunRequest request_;
  const Messages& messages_;
  experiment::Experiment experiment_;
  std::string resolved_;
  experiment::LoggedTopics logged_;
  std::optional<OutputFolder> folder_;
  std::optional<RunLog> log_;
};

}  // namespace sinew::cli
