// cli/run_log.h - joins a run to its log: what the recorder sees goes into the file as it comes.
#pragma once

#include <filesystem>
#include <string>

#include "sinew/experiment/run.h"
#include "sinew/log/writer.h"

namespace sinew::cli {

class RunLog {
 public:
  // Only the topics that log.channels names. Throws config::Error where it names none, log::Error
  // where the file cannot be made.
  RunLog(const std::filesystem::path& file, const experiment::Experiment& experiment,
         const std::string& resolved);

  // The log must outlive the run.
  void tap(experiment::RunOptions& options);

  // Indexes the file. Without it, the file is one that was cut off.
  void finish() { writer_.finish(); }

 private:
  struct Chosen {
    std::vector<signals::Topic> topics;    // that are logged
    std::vector<std::uint16_t> of_series;  // their places, by the recorder's order
  };
  static Chosen choose(const experiment::Experiment& experiment);
  RunLog(const std::filesystem::path& file, const experiment::Experiment& experiment,
         const std::string& resolved, Chosen chosen);

  std::vector<std::uint16_t> of_series_;
  log::Writer writer_;
};

}  // namespace sinew::cli
