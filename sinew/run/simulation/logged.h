// run/simulation/logged.h - selection of the channels of a run's log, by log.channels.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sinew/config/origin.h"
#include "sinew/experiment/experiment.h"
#include "sinew/log/writer.h"
#include "sinew/signals/table.h"

namespace sinew::run {

// The numbers of topics: in the recorded table, and in the log.
struct LoggedTopics {
  std::vector<signals::Topic> topics;    // in the order of the log
  std::vector<std::uint16_t> of_series;  // number in the log, by recorded series; not_tapped: not
                                         // logged
};

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

}  // namespace sinew::run
