#include "sinew/run/simulation/logged.h"

#include <algorithm>
#include <stdexcept>

#include "sinew/experiment/globs.h"
#include "sinew/run/controllers/columns.h"
#include "sinew/run/simulation/recorder.h"

namespace sinew::run {

namespace {

// Throws if the table does not have the topics that the selection was made from.
void refuse_other_topics(const signals::Table& table, const LoggedTopics& logged) {
  bool same = table.series.size() == logged.of_series.size();
  for (std::size_t s = 0; same && s < table.series.size(); ++s) {
    const std::uint16_t topic = logged.of_series[s];
    same = topic == not_tapped || (topic < logged.topics.size() &&
                                   logged.topics[topic].name == table.series[s].topic.name);
  }
  if (!same) throw std::logic_error("a table of other topics than its log's");
}

}  // namespace

LoggedTopics logged_topics(const signals::Table& table) {
  LoggedTopics out;
  for (const signals::Series& s : table.series) {
    out.of_series.push_back(static_cast<std::uint16_t>(out.topics.size()));
    out.topics.push_back(s.topic);
  }
  return out;
}

LoggedTopics logged_topics(const std::vector<signals::Topic>& recorded,
                           const std::vector<std::string>& patterns, const config::Origins& origins,
                           const std::string& path) {
  const config::Origin* origin = config::find_origin(origins, "log.channels");
  const bool written = origin && !origin->is_default;
  const std::vector<std::string> chosen =
      experiment::select(patterns, config::names_of(recorded),
                         written ? origin->where : config::Location{path, 0, 0}, "log.channels");
  LoggedTopics out;
  for (const signals::Topic& topic : recorded) {
    const bool is_chosen = std::ranges::find(chosen, topic.name) != chosen.end();
    out.of_series.push_back(is_chosen ? static_cast<std::uint16_t>(out.topics.size()) : not_tapped);
    if (is_chosen) out.topics.push_back(topic);
  }
  return out;
}

LoggedTopics logged_topics(const experiment::Experiment& e) {
  return logged_topics(topics(e), e.log.channels, e.origins, e.path);
}

bool is_whole(const LoggedTopics& logged) {
  return std::ranges::find(logged.of_series, not_tapped) == logged.of_series.end();
}

signals::Table logged_part(signals::Table&& table, const LoggedTopics& logged) {
  refuse_other_topics(table, logged);
  signals::Table out;
  out.complete = table.complete;
  for (std::size_t s = 0; s < table.series.size(); ++s)
    if (logged.of_series[s] != not_tapped) out.series.push_back(std::move(table.series[s]));
  return out;
}

void write(log::Writer& log, const signals::Table& table, const LoggedTopics& logged) {
  refuse_other_topics(table, logged);
  std::vector<std::size_t> next(table.series.size(), 0);  // sample of each series
  std::vector<double> values;
  for (;;) {
    // Find the earliest sample; at equal times, that of the first series.
    std::int64_t now = 0;
    std::size_t of = next.size();
    for (std::size_t s = 0; s < next.size(); ++s) {
      const signals::Times& times = table.series[s].time_ns;
      if (logged.of_series[s] == not_tapped || next[s] == times.size()) continue;
      if (of < next.size() && times[next[s]] >= now) continue;
      now = times[next[s]];
      of = s;
    }
    if (of == next.size()) return;
    values.clear();
    for (const signals::Column& column : table.series[of].columns)
      values.push_back(column[next[of]]);
    log.push(logged.of_series[of], now, values);
    ++next[of];
  }
}

}  // namespace sinew::run
