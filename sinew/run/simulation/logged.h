// run/simulation/logged.h - which of a run's channels its log holds, by log.channels.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sinew/config/origin.h"
#include "sinew/experiment/experiment.h"
#include "sinew/log/writer.h"
#include "sinew/signals/table.h"

namespace sinew::run {

// A topic has two numbers: its place in what the run records, and its place in the log.
struct LoggedTopics {
  std::vector<signals::Topic> topics;    // by their place in the log
  std::vector<std::uint16_t> of_series;  // by the place in what is recorded; not_tapped: not logged
};

// All of a table's.
LoggedTopics logged_topics(const signals::Table& table);

// Those that the patterns mean, in the order in which they are recorded, whatever the patterns'
// own. `origins` and `path` are the experiment's, and say where the patterns stand. Throws
// config::Error for a pattern that means no topic.
LoggedTopics logged_topics(const std::vector<signals::Topic>& recorded,
                           const std::vector<std::string>& patterns, const config::Origins& origins,
                           const std::string& path);
LoggedTopics logged_topics(const experiment::Experiment& experiment);

// Returns whether the log holds all that is recorded.
bool is_whole(const LoggedTopics& logged);

// The part of a run's table that its log holds, as log::read() gives it back. Takes it out of
// there.
signals::Table logged_part(signals::Table&& table, const LoggedTopics& logged);

// Pushes that part in the order of its times, into a log that was made for `logged.topics`. Throws
// std::logic_error for a table of other topics than `logged` is of.
void write(log::Writer& log, const signals::Table& table, const LoggedTopics& logged);

}  // namespace sinew::run
