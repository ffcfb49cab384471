#include "sinew/run/folder/run_log.h"

#include <fmt/format.h>

#include <stdexcept>

#include "sinew/config/compose.h"
#include "sinew/config/utf8.h"
#include "sinew/log/reader.h"

namespace sinew::run {

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

}  // namespace

std::string experiment_in(const std::filesystem::path& log) {
  return metadata_in(log, "experiment");
}

std::string ended_in(const std::filesystem::path& log) { return metadata_in(log, "ended"); }

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
