// run/folder/run_log.h - joins a run to its log: recorded values are written to the file as they
// come.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sinew/config/node.h"
#include "sinew/config/origin.h"
#include "sinew/experiment/experiment.h"
#include "sinew/log/writer.h"
#include "sinew/run/folder/notices.h"
#include "sinew/run/folder/run_folder.h"
#include "sinew/run/simulation/run.h"
#include "sinew/signals/table.h"

namespace sinew::run {

// Selection of the channels of a run's log, by log.channels.

// The numbers of topics: in the recorded table, and in the log.
struct LoggedTopics {
  std::vector<signals::Topic> topics;    // in the order of the log
  std::vector<std::uint16_t> of_series;  // number in the log, by recorded series; not_tapped: not
                                         // logged
};

// Selects the topics for which `chosen` holds.
LoggedTopics logged_topics(const std::vector<signals::Topic>& recorded,
                           const std::function<bool(const signals::Topic&)>& chosen);

// Selects all topics of a table.
LoggedTopics logged_topics(const signals::Table& table);

// Select the topics that match the patterns, in the order in which they are recorded. `origins` and
// `path` are the experiment's, and give the lines of the patterns. Throw config::Error for a
// pattern that matches no topic.
LoggedTopics logged_topics(const std::vector<signals::Topic>& recorded,
                           const std::vector<std::string>& patterns, const config::Origins& origins,
                           const std::string& path);
LoggedTopics logged_topics(const experiment::Experiment& experiment);

// Returns whether the log contains everything that is recorded.
bool is_whole(const LoggedTopics& logged);

// Returns the logged part of a run's table, as log::read() would return it. Moves the samples
// out of the table.
signals::Table logged_part(signals::Table&& table, const LoggedTopics& logged);

// Writes the logged part in the order of its times, into a log that was created for
// `logged.topics`. Throws std::logic_error if the table has other topics than those of `logged`.
void write(log::Writer& log, const signals::Table& table, const LoggedTopics& logged);

// Returns the name of the experiment in a log; empty if it has none. Throws log::Error if the log
// cannot be read, as does the next one.
std::string experiment_in(const std::filesystem::path& log);

// Throws std::runtime_error if the log's run ended early, for uses that require a finished run.
void require_finished(const std::filesystem::path& log);

// A stored run as read from its files.
struct ReadRun {
  std::filesystem::path log;
  config::Node resolved;
  signals::Table table;
  std::string name;   // name of its experiment; empty if unknown
  std::string ended;  // why it ended early
};

// Reads a run, described by `machine`, or by its resolved.toml if `machine` is empty. Warns if it
// ended early or its log is cut off; `shows` is the subject of that warning: "the page shows".
ReadRun read_run(const RunFiles& run, const std::string& machine, const std::string& shows,
                 const Notices& notices);

class RunLog {
 public:
  // Throws log::Error if the file cannot be created. `name` and `seed` are the experiment's.
  RunLog(const std::filesystem::path& file, const std::string& name, int seed,
         const std::string& resolved, LoggedTopics logged);

  // Writes an existing table in the order of its times.
  void write(const signals::Table& table);

  // Makes a run with these options write to the log, which must outlive the run.
  void tap(RunOptions& options);

  // Writes the index of the file, without which it reads as cut off. `resolved` is the final
  // description of the run, which may be the constructor's. `ended` states why the run was not
  // finished; empty: it was.
  void finish(const std::string& resolved, const std::string& ended);

 private:
  std::vector<std::pair<std::string, std::string>> metadata(const std::string& resolved) const;

  std::string name_;
  int seed_;
  LoggedTopics logged_;
  log::Writer writer_;
};

}  // namespace sinew::run
