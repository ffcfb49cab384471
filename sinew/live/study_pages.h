// live/study_pages.h - page of one or two studies that may still grow, and of runs of their rows,
// for a server.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <future>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "sinew/live/server.h"
#include "sinew/run/folder/notices.h"
#include "sinew/tune/page/study_view.h"

namespace sinew::live {

// A study's file and its changes while it grows: new rows, in any order, and rows that are written
// again. It is used by one thread.
class StudyFeed {
 public:
  // Throws as tune::study_view() does.
  explicit StudyFeed(const std::filesystem::path& file);

  // Reads the file if it has changed. Throws as tune::study_view() does; the last content then
  // stays.
  void refresh();

  // Return the study as last read, and the number of changes so far.
  const tune::StudyView& study() const { return study_; }
  std::size_t changes() const { return changes_.size(); }

  // Returns the rows of all changes but the first `known`, each once, with their current values.
  std::vector<tune::StudyRow> since(std::size_t known) const;

 private:
  using Stamp = std::array<long long, 4>;  // times and sizes of the file and of its write-ahead log

  Stamp stamp() const;

  std::filesystem::path file_;
  Stamp seen_{};
  tune::StudyView study_;
  std::vector<std::size_t> changes_;       // numbers of rows
  std::map<std::size_t, std::size_t> at_;  // index of a row by its number
};

// Runs of a study's rows, each made once on request. A run has a thread of its own; the object is
// used by one thread. Its destructor stops unfinished runs.
class RowRuns {
 public:
  RowRuns() = default;
  ~RowRuns();
  RowRuns(const RowRuns&) = delete;
  RowRuns& operator=(const RowRuns&) = delete;

  // Returns whether the run of a row was started.
  bool has(std::size_t row) const { return runs_.contains(row); }

  // Returns whether the greatest number of simultaneous runs is reached.
  bool is_busy();

  // Starts a run as `sinew run` does, into runs/<experiment>/<n>.
  void begin(std::size_t row, const tune::StudyRun& run);

  // Returns the folder of a run, or empty if it does not end within 1.5 s. Throws the exception of
  // the run.
  std::optional<std::filesystem::path> folder(std::size_t row);

 private:
  std::atomic<bool> stop_{false};
  std::map<std::size_t, std::shared_future<std::filesystem::path>> runs_;
};

class StudyPages {
 public:
  // Serves one file or two. Throws as tune::study_view() does, and std::runtime_error if the
  // library was built without its pages.
  StudyPages(const std::vector<std::filesystem::path>& files, run::Notices notices);

  // Returns the page at a path: "/" is the study's page, "/rows/12" JSON with the rows since change
  // 12, "/run/3" the page of a run of row 3, which is run on request; "/b/rows/12" and "/b/run/3"
  // are those of the second study. A run that fails gives status 500 with the error's message.
  Reply get(std::string_view path);

 private:
  struct Study {
    explicit Study(const std::filesystem::path& file) : feed(file) {}

    StudyFeed feed;
    RowRuns runs;
    std::set<std::size_t> reported;  // rows whose folder was reported
  };

  Reply page();
  Reply rows(Study& study, std::size_t known);
  Reply run_of(Study& study, std::size_t row);

  const run::Notices notices_;
  std::deque<Study> studies_;  // a deque, because unfinished runs cannot be moved
};

}  // namespace sinew::live
