// cli/run_log.h - joins a run to its log: what the recorder sees goes into the file as it comes.
#pragma once

#include <filesystem>
#include <string>

#include "sinew/experiment/rig/run.h"
#include "sinew/experiment/run.h"
#include "sinew/log/writer.h"

namespace sinew::cli {

// What of a run is logged.
struct LoggedTopics {
  std::vector<signals::Topic> topics;
  std::vector<std::uint16_t> of_series;  // their places, by the recorder's order
};

// All of a table's.
LoggedTopics logged_topics(const signals::Table& table);

// By log.channels. Throws config::Error where a pattern means no topic.
LoggedTopics logged_topics(const experiment::Experiment& experiment);
LoggedTopics logged_topics(const rig::Experiment& experiment);

// The part of a run's table that its log holds, as log::read() gives it back. Takes it out of
// there.
signals::Table logged_part(signals::Table&& table, const LoggedTopics& logged);

// The experiment that a log says that it is of; empty where it does not.
std::string experiment_in(const std::filesystem::path& log);

class RunLog {
 public:
  // Throws log::Error where the file cannot be made. `name` and `seed` are the experiment's.
  RunLog(const std::filesystem::path& file, const std::string& name, int seed,
         const std::string& resolved, LoggedTopics logged);

  // A table that is there already, in the order of its times.
  void write(const signals::Table& table);

  // The log must outlive the run.
  void tap(experiment::RunOptions& options);

  // Indexes the file. Without it, the file is one that was cut off. `resolved`: what was run after
  // all, in place of the constructor's.
  void finish() { writer_.finish(); }
  void finish(const std::string& resolved) { writer_.finish(metadata(resolved)); }

 private:
  std::vector<std::pair<std::string, std::string>> metadata(const std::string& resolved) const;

  std::string name_;
  int seed_;
  std::vector<std::uint16_t> of_series_;
  log::Writer writer_;
};

}  // namespace sinew::cli
