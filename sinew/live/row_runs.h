// live/row_runs.h - runs of a study's rows, each made once, when somebody wants to look at it.
#pragma once

#include <atomic>
#include <filesystem>
#include <future>
#include <map>
#include <optional>

#include "sinew/tune/page/study_view.h"

namespace sinew::live {

// A run goes on a thread of its own; the object belongs to one thread. Its end stops those that go.
class RowRuns {
 public:
  RowRuns() = default;
  ~RowRuns();
  RowRuns(const RowRuns&) = delete;
  RowRuns& operator=(const RowRuns&) = delete;

  // Was that row's run made, or is it being made?
  bool has(std::size_t row) const { return runs_.contains(row); }

  // Whether one more would have to wait for those that go.
  bool is_busy();

  // Runs it as `sinew run` would, into runs/<experiment>/<n>.
  void begin(std::size_t row, const tune::StudyRun& run);

  // Returns the folder that keeps the run, nothing where it still goes after a moment. Throws what
  // the run threw.
  std::optional<std::filesystem::path> folder(std::size_t row);

 private:
  std::atomic<bool> stop_{false};
  std::map<std::size_t, std::shared_future<std::filesystem::path>> runs_;
};

}  // namespace sinew::live
