#include "cli/run_log.h"

#include <algorithm>

#include "cli/globs.h"
#include "sinew/log/reader.h"

namespace sinew::cli {

namespace {

// Called from the loop. A file that fails is told of by finish().
void push(void* writer, std::uint16_t topic, std::int64_t time_ns,
          std::span<const double> values) noexcept {
  (void)static_cast<log::Writer*>(writer)->push(topic, time_ns, values);
}

}  // namespace

namespace {

LoggedTopics chosen(const std::vector<signals::Topic>& all,
                    const std::vector<std::string>& channels, const config::Origins& origins,
                    const std::string& path) {
  const config::Origin* origin = config::find_origin(origins, "log.channels");
  const bool written = origin && !origin->is_default;
  const std::vector<bool> wanted =
      select(channels, config::names_of(all),
             written ? origin->where : config::Location{path, 0, 0}, "log.channels");
  LoggedTopics out;
  for (std::size_t i = 0; i < all.size(); ++i) {
    out.of_series.push_back(wanted[i] ? static_cast<std::uint16_t>(out.topics.size())
                                      : experiment::not_tapped);
    if (wanted[i]) out.topics.push_back(all[i]);
  }
  return out;
}

}  // namespace

LoggedTopics logged_topics(const experiment::Experiment& e) {
  return chosen(experiment::topics(e), e.log.channels, e.origins, e.path);
}

LoggedTopics logged_topics(const rig::Experiment& e) {
  return chosen(rig::topics(e), e.log.channels, e.origins, e.path);
}

LoggedTopics logged_topics(const signals::Table& table) {
  LoggedTopics out;
  for (const signals::Series& s : table.series) {
    out.of_series.push_back(static_cast<std::uint16_t>(out.topics.size()));
    out.topics.push_back(s.topic);
  }
  return out;
}

signals::Table logged_part(signals::Table&& table, const LoggedTopics& logged) {
  signals::Table out;
  for (std::size_t s = 0; s < table.series.size(); ++s)
    if (logged.of_series[s] != experiment::not_tapped)
      out.series.push_back(std::move(table.series[s]));
  return out;
}

std::string experiment_in(const std::filesystem::path& log) {
  for (const auto& [key, value] : log::read_metadata(log))
    if (key == "experiment") return value;
  return "";
}

RunLog::RunLog(const std::filesystem::path& file, const std::string& name, int seed,
               const std::string& resolved, LoggedTopics logged)
    : name_(name),
      seed_(seed),
      of_series_(std::move(logged.of_series)),
      writer_(file, std::move(logged.topics), metadata(resolved), {.version = SINEW_VERSION}) {}

std::vector<std::pair<std::string, std::string>> RunLog::metadata(
    const std::string& resolved) const {
  return {{"experiment", name_},
          {"seed", std::to_string(seed_)},
          {"version", SINEW_VERSION},
          {"resolved", resolved}};
}

void RunLog::write(const signals::Table& table) {
  struct At {
    std::int64_t time_ns;
    std::uint16_t topic;
    std::size_t sample;
  };
  std::vector<At> all;
  for (std::size_t s = 0; s < table.series.size(); ++s)
    for (std::size_t i = 0;
         of_series_[s] != experiment::not_tapped && i < table.series[s].time_ns.size(); ++i)
      all.push_back({table.series[s].time_ns[i], of_series_[s], i});
  std::ranges::stable_sort(all, {}, &At::time_ns);

  std::vector<double> values;
  for (const At& at : all) {
    values.clear();
    for (const auto& column : table.series[at.topic].columns) values.push_back(column[at.sample]);
    writer_.push(at.topic, at.time_ns, values);
  }
}

void RunLog::tap(experiment::RunOptions& options) {
  options.tap = {&writer_, push};
  options.tapped = of_series_;
}

}  // namespace sinew::cli
