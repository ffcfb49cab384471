// run/folder/kept_run.h - a run and the folder that keeps it: what comes before the loop, and
// after.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/summary.h"
#include "sinew/config/node.h"
#include "sinew/run/folder/notices.h"
#include "sinew/run/folder/run_folder.h"
#include "sinew/run/folder/run_log.h"
#include "sinew/run/simulation/place.h"
#include "sinew/run/simulation/run.h"

namespace sinew::run {

// A request: the experiment, and where its run is kept.
struct RunRequest {
  std::string experiment;          // its file
  std::string folder;              // empty: runs/<experiment>/<n>, counting up
  std::vector<std::string> sets;   // "key=value" in place of the file's
  bool force = false;              // replace the run that is in the folder
  bool allow_unreachable = false;  // aim at the nearest point where the foot path is out of reach
  bool report = true;              // leave report.html
  std::string units;               // in which it begins (config/shown_units.h); empty: as set
  std::string port;                // where it runs (place.h); empty: simulated
  bool clear_fault = false;        // a board's fault that has to be looked into has been
  const std::atomic<bool>* stop = nullptr;  // true: a board is waited for no longer
};

// The files and figures that a run left.
struct Kept {
  std::filesystem::path folder;
  analysis::Summary summary;
  analysis::Machine machine;      // as `sinew analyze` will read it
  std::string json;               // summary.json
  double duration = 0, wall = 0;  // simulated, and of the clock on the wall [s]
  bool page = false;              // there is a report.html
};

// KeptRun holds the folder of a run locked, and its log, from before the loop until it is kept.
class KeptRun {
 public:
  // Loads the experiment, has its board ready where it is to run on one, and opens its folder and
  // its log. Throws config::Error for what cannot be run, or kept, and plant::BoardError.
  explicit KeptRun(RunRequest request, Notices notices = {});

  // Returns what is run, as it is written and as it was read.
  const experiment::Experiment& experiment() const { return experiment_; }
  const std::string& resolved() const { return resolved_; }  // the text of resolved.toml
  const config::Node& values() const { return values_; }     // what it says
  // Returns where it is kept.
  const std::filesystem::path& folder() const { return folder_->path(); }
  RunLog* log() { return log_ ? &*log_ : nullptr; }  // nullptr where the experiment wants none
  // Returns where it runs.
  const Place& place() const { return *place_; }

  // The run goes to its place and into its log, where it has one.
  void apply(RunOptions& options);

  // After the loop: the log's end, summary and page into the folder. What was changed on the way
  // stands in resolved.toml. Only then it takes the place of an older run. Throws where the run
  // ended early, with its last records, and where it was stopped: then its log reads as cut off.
  Kept keep(run::Outcome outcome);

 private:
  void resolve();
  void finish_log(const run::Outcome& outcome);
  [[noreturn]] void break_off(const run::Outcome& outcome);
  Kept keep_files(run::Outcome& outcome, analysis::Machine machine);
  void warn(const std::vector<std::string>& of_the_log, const run::Outcome& outcome) const;
  bool write_page(const analysis::Analysis& of_all, run::Outcome& outcome);
  void keep_trip(const analysis::Analysis& a, const run::Outcome& outcome);
  std::string keep_fault_log();

  RunRequest request_;
  Notices notices_;
  experiment::Experiment experiment_;
  std::string resolved_;
  config::Node values_;  // what resolved_ says, as `sinew analyze` will read it
  LoggedTopics logged_;
  std::unique_ptr<Place> place_;
  std::optional<OutputFolder> folder_;
  std::optional<RunLog> log_;
};

// Runs an experiment as fast as it goes and keeps it. Throws as KeptRun does.
Kept run_and_keep(RunRequest request, Notices notices = {});

// Keeps a table that is there already, as of a recording from elsewhere, as the run of `e`;
// `where.folder` and `where.force` say where. Throws config::Error or log::Error.
Kept keep_table(const signals::Table& table, const experiment::Experiment& e,
                const RunRequest& where, const Notices& notices = {});

}  // namespace sinew::run
