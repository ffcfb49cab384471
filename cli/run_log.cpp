#include "cli/run_log.h"

#include "cli/globs.h"

namespace sinew::cli {

namespace {

// Called from the loop. A file that fails is told of by finish().
void push(void* writer, std::uint16_t topic, std::int64_t time_ns,
          std::span<const double> values) noexcept {
  (void)static_cast<log::Writer*>(writer)->push(topic, time_ns, values);
}

}  // namespace

RunLog::Chosen RunLog::choose(const experiment::Experiment& e) {
  const std::vector<signals::Topic> all = experiment::topics(e.robot);
  const std::vector<bool> wanted = select(e.log.channels, names_of(all), "log.channels");
  Chosen out;
  for (std::size_t i = 0; i < all.size(); ++i) {
    out.of_series.push_back(wanted[i] ? static_cast<std::uint16_t>(out.topics.size())
                                      : experiment::not_tapped);
    if (wanted[i]) out.topics.push_back(all[i]);
  }
  return out;
}

RunLog::RunLog(const std::filesystem::path& file, const experiment::Experiment& e,
               const std::string& resolved)
    : RunLog(file, e, resolved, choose(e)) {}

RunLog::RunLog(const std::filesystem::path& file, const experiment::Experiment& e,
               const std::string& resolved, Chosen chosen)
    : of_series_(std::move(chosen.of_series)),
      writer_(file, std::move(chosen.topics),
              {{"experiment", e.name},
               {"seed", std::to_string(e.seed)},
               {"version", SINEW_VERSION},
               {"resolved", resolved}},
              {.version = SINEW_VERSION}) {}

void RunLog::tap(experiment::RunOptions& options) {
  options.tap = {&writer_, push};
  options.tapped = of_series_;
}

}  // namespace sinew::cli
