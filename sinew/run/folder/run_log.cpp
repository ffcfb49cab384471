#include "sinew/run/folder/run_log.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "sinew/config/compose.h"
#include "sinew/config/utf8.h"
#include "sinew/experiment/globs.h"
#include "sinew/log/reader.h"
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

LoggedTopics logged_topics(const std::vector<signals::Topic>& recorded,
                           const std::function<bool(const signals::Topic&)>& chosen) {
  LoggedTopics out;
  for (const signals::Topic& topic : recorded) {
    const bool is_chosen = chosen(topic);
    out.of_series.push_back(is_chosen ? static_cast<std::uint16_t>(out.topics.size()) : not_tapped);
    if (is_chosen) out.topics.push_back(topic);
  }
  return out;
}

LoggedTopics logged_topics(const signals::Table& table) {
  std::vector<signals::Topic> all;
  for (const signals::Series& s : table.series) all.push_back(s.topic);
  return logged_topics(all, [](const signals::Topic&) { return true; });
}

LoggedTopics logged_topics(const std::vector<signals::Topic>& recorded,
                           const std::vector<std::string>& patterns, const config::Origins& origins,
                           const std::string& path) {
  const config::Origin* origin = config::find_origin(origins, "log.channels");
  const bool written = origin && !origin->is_default;
  const std::vector<std::string> chosen =
      experiment::select(patterns, config::names_of(recorded),
                         written ? origin->where : config::Location{path, 0, 0}, "log.channels");
  return logged_topics(recorded, [&](const signals::Topic& topic) {
    return std::ranges::find(chosen, topic.name) != chosen.end();
  });
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

namespace {

// Called from the loop. finish() reports errors of the file.
void push(void* writer, std::uint16_t topic, std::int64_t time_ns,
          std::span<const double> values) noexcept {
  (void)static_cast<log::Writer*>(writer)->push(topic, time_ns, values);
}

std::string metadata_in(const std::filesystem::path& log, std::string_view name) {
  for (const auto& [key, value] : log::read_metadata(log))
    if (key == name) return value;
  return "";
}

// Returns why the log's run ended early, as formulated by cause_of(); empty if it was finished.
std::string ended_in(const std::filesystem::path& log) { return metadata_in(log, "ended"); }

}  // namespace

std::string experiment_in(const std::filesystem::path& log) {
  return metadata_in(log, "experiment");
}

void require_finished(const std::filesystem::path& log) {
  const std::string ended = ended_in(log);
  if (!ended.empty())
    throw std::runtime_error(
        fmt::format("{}: the run was ended: {}; a run that was not finished has no summary; sinew "
                    "report shows what it did",
                    log.string(), ended));
}

ReadRun read_run(const RunFiles& run, const std::string& machine, const std::string& shows,
                 const Notices& notices) {
  ReadRun out{run.log, config::compose(machine_of(run, machine).string()), log::read(run.log),
              experiment_in(run.log), ended_in(run.log)};
  if (!out.ended.empty())
    notices.warning(fmt::format("{}: the run was ended: {}; {} it until then", run.log.string(),
                                out.ended, shows));
  if (!out.table.complete)
    notices.warning(fmt::format("{} was cut off or is damaged; {} what stands before",
                                run.log.string(), shows));
  return out;
}

RunLog::RunLog(const std::filesystem::path& file, const std::string& name, int seed,
               const std::string& resolved, run::LoggedTopics logged)
    : name_(name),
      seed_(seed),
      logged_(std::move(logged)),
      writer_(file, logged_.topics, metadata(resolved), {.version = SINEW_VERSION}) {}

std::vector<std::pair<std::string, std::string>> RunLog::metadata(
    const std::string& resolved) const {
  return {{"experiment", config::in_utf8(name_)},
          {"seed", std::to_string(seed_)},
          {"version", SINEW_VERSION},
          {"resolved", resolved}};
}

void RunLog::write(const signals::Table& table) { run::write(writer_, table, logged_); }

void RunLog::finish(const std::string& resolved, const std::string& ended) {
  std::vector<std::pair<std::string, std::string>> said = metadata(resolved);
  if (!ended.empty()) said.emplace_back("ended", ended);
  writer_.finish(said);
}

void RunLog::tap(run::RunOptions& options) {
  options.tap = {&writer_, push};
  options.tapped = logged_.of_series;
}

}  // namespace sinew::run
