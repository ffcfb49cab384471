// run/folder/run_log.h - joins a run to its log: what the recorder sees goes into the file as it
// comes.
#pragma once

#include <filesystem>
#include <string>

#include "sinew/log/writer.h"
#include "sinew/run/simulation/logged.h"
#include "sinew/run/simulation/run.h"

namespace sinew::run {

// Returns the experiment that a log says that it is of; empty where it does not. Throws log::Error
// where it cannot be read, as do the next two.
std::string experiment_in(const std::filesystem::path& log);

// Returns why its run was ended before it was finished, in the words of cause_of(); empty where it
// was not.
std::string ended_in(const std::filesystem::path& log);

// Throws std::runtime_error where the log's run was ended: for what speaks of whole runs only.
void require_finished(const std::filesystem::path& log);

class RunLog {
 public:
  // Throws log::Error where the file cannot be made. `name` and `seed` are the experiment's.
  RunLog(const std::filesystem::path& file, const std::string& name, int seed,
         const std::string& resolved, LoggedTopics logged);

  // Writes a table that is there already, in the order of its times.
  void write(const signals::Table& table);

  // Makes a run of these options write to the log, which must outlive the run.
  void tap(RunOptions& options);

  // Indexes the file. Without it, the file is one that was cut off. `resolved`: what was run after
  // all, which may be the constructor's. `ended`: why the run was not finished; empty where it was.
  void finish(const std::string& resolved, const std::string& ended);

 private:
  std::vector<std::pair<std::string, std::string>> metadata(const std::string& resolved) const;

  std::string name_;
  int seed_;
  LoggedTopics logged_;
  log::Writer writer_;
};

}  // namespace sinew::run
