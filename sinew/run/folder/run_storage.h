// run/folder/run_storage.h - a run and the folder that stores it: the work before the loop and
// after it.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/summary.h"
#include "sinew/config/node.h"
#include "sinew/experiment/experiment.h"
#include "sinew/run/folder/notices.h"
#include "sinew/run/folder/run_folder.h"
#include "sinew/run/folder/run_log.h"
#include "sinew/run/simulation/place.h"
#include "sinew/run/simulation/run.h"

namespace sinew::run {

// The experiment and the folder of its run.
struct RunRequest {
  std::string experiment;          // its file
  std::string folder;              // empty: runs/<experiment>/<n>, counting up
  std::vector<std::string> sets;   // "key=value", overrides the file's
  bool force = false;              // replaces the run in the folder
  bool allow_unreachable = false;  // uses the nearest point where the foot path is out of reach
  bool report = true;              // writes report.html
  std::string units;               // initial units of the page (config/shown_units.h); empty: as
                                   // set
  std::string port;                // destination of the run (place.h); empty: simulation
  bool clear_fault = false;        // confirms that a board's fault has been examined
  std::vector<std::filesystem::path> inputs;  // further files that are read and not replaced
  const std::atomic<bool>* stop = nullptr;    // true: ends the run, and waiting for a board
};

// The files and figures of a completed run.
struct StoredRun {
  std::filesystem::path folder;
  analysis::Summary summary;
  analysis::Machine machine;      // as `sinew analyze` will read it
  std::string json;               // summary.json
  double duration = 0, wall = 0;  // simulated time and wall time [s]
  bool page = false;              // whether report.html exists
};

// Holds the locked folder and the log of a run from before the loop until the run is stored.
class RunStorage {
 public:
  // Loads the experiment, prepares its board if it runs on one, and opens its folder and its log.
  // Throws config::Error if it cannot be run or stored, and plant::BoardError.
  explicit RunStorage(RunRequest request, Notices notices = {});

  // Return the experiment, its text as written, and its values as read back.
  const experiment::Experiment& experiment() const { return experiment_; }
  const std::string& resolved() const { return resolved_; }  // the text of resolved.toml
  const config::Node& values() const { return values_; }     // contents of `resolved()`
  // Returns the folder of the run.
  const std::filesystem::path& folder() const { return folder_->path(); }
  RunLog* log() { return log_ ? &*log_ : nullptr; }  // nullptr if the experiment disables the log
  // Returns the destination of the run.
  const Place& place() const { return *place_; }

  // Connects the run to its destination and to its log, if any.
  void apply(RunOptions& options);

  // Completes the log and writes summary and page into the folder after the loop. Changes made
  // during the run are added to resolved.toml. Then the run replaces an older one. If the run ended
  // early, throws with its last records; if it was stopped, throws and leaves the log as if cut
  // off.
  StoredRun store(run::Outcome outcome);

 private:
  void resolve();
  void finish_log(const run::Outcome& outcome);
  [[noreturn]] void break_off(const run::Outcome& outcome);
  StoredRun store_files(run::Outcome& outcome, analysis::Machine machine);
  void warn(const std::vector<std::string>& of_the_log, const run::Outcome& outcome) const;
  std::string hash_of_log(const signals::Table& table) const;
  bool write_page(const analysis::Analysis& of_all, run::Outcome& outcome);
  void store_trip(const analysis::Analysis& a, const run::Outcome& outcome);
  std::string store_fault_log();

  RunRequest request_;
  Notices notices_;
  experiment::Experiment experiment_;
  std::string resolved_;
  config::Node values_;  // contents of resolved_, as `sinew analyze` will read them
  LoggedTopics logged_;
  std::unique_ptr<Place> place_;
  std::optional<OutputFolder> folder_;
  std::optional<RunLog> log_;
};

// Runs an experiment as fast as possible and stores it. Throws like RunStorage.
StoredRun run_and_store(RunRequest request, Notices notices = {});

// Stores an existing table, for example an external recording, as the run of `e`; `where.folder`
// and `where.force` select the folder. Throws config::Error or log::Error.
StoredRun store_table(const signals::Table& table, const experiment::Experiment& e,
                      const RunRequest& where, const Notices& notices = {});

// Throws config::Error for what buildable() accepts and no run does: channels of the log that do
// not exist and, unless they are allowed, foot paths out of reach.
void refuse_unrunnable(const experiment::Experiment& experiment, bool allow_unreachable);

// Returns an experiment whose machine, plan, controller, channels and reported values were checked,
// as `sinew run` and `sinew check` do. `sets` are "key=value" and override the file's. Throws
// config::Error with the lines of the files; with `allow_unreachable` a foot path may leave the
// reach.
experiment::Experiment runnable(const std::string& path, const std::vector<std::string>& sets,
                                bool allow_unreachable);

}  // namespace sinew::run
