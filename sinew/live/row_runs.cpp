#include "sinew/live/row_runs.h"

#include <algorithm>
#include <chrono>

#include "sinew/run/folder/kept_run.h"

namespace sinew::live {
namespace {

constexpr auto moment = std::chrono::milliseconds(1500);
constexpr std::ptrdiff_t most_at_once = 4;

std::filesystem::path run_and_keep(const tune::StudyRun& run, const std::atomic<bool>& stop) {
  const run::RunRequest request{.experiment = run.experiment,
                                .folder = "",
                                .sets = run.sets,
                                .allow_unreachable = run.allow_unreachable};
  run::KeptRun kept(request);
  run::RunOptions options{.stop = &stop};
  kept.apply(options);
  return kept.keep(run::run(kept.experiment(), options)).folder;
}

bool goes(const std::shared_future<std::filesystem::path>& run) {
  return run.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
}

}  // namespace

RowRuns::~RowRuns() { stop_ = true; }  // each future waits for its thread

bool RowRuns::is_busy() {
  return std::ranges::count_if(runs_, [](const auto& r) { return goes(r.second); }) >= most_at_once;
}

void RowRuns::begin(std::size_t row, const tune::StudyRun& run) {
  runs_[row] =
      std::async(std::launch::async, [this, run] { return run_and_keep(run, stop_); }).share();
}

std::optional<std::filesystem::path> RowRuns::folder(std::size_t row) {
  const auto& run = runs_.at(row);
  if (run.wait_for(moment) != std::future_status::ready) return std::nullopt;
  return run.get();
}

}  // namespace sinew::live
