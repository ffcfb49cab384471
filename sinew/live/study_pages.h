// live/study_pages.h - the page of a study that may still grow, or of two beside each other, and of
// runs of their rows, for a server.
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

// A study's file as it grows: what is new in it since somebody asked.

// One thread. Rows come in any order, and a row may be written anew; each of both is a change.
class StudyFeed {
 public:
  // Throws as tune::study_view() does.
  explicit StudyFeed(const std::filesystem::path& file);

  // Reads the file where it was written since. Throws as tune::study_view() does; what was known
  // stays.
  void look();

  // Returns the study as it was read last, and how many changes of it there were.
  const tune::StudyView& study() const { return study_; }
  std::size_t changes() const { return changes_.size(); }

  // Returns the rows of all changes but the first `known`, each once, as they are now.
  std::vector<tune::StudyRow> since(std::size_t known) const;

 private:
  using Stamp =
      std::array<long long, 4>;  // when and how large the file is, and what SQLite has beside it

  Stamp stamp() const;

  std::filesystem::path file_;
  Stamp seen_{};
  tune::StudyView study_;
  std::vector<std::size_t> changes_;       // numbers of rows
  std::map<std::size_t, std::size_t> at_;  // of a row's number: its place
};

// Runs of a study's rows, each made once, when somebody wants to look at it.

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

class StudyPages {
 public:
  // One file or two. Throws as tune::study_view() does, and std::runtime_error where the library
  // was built without its pages.
  StudyPages(const std::vector<std::filesystem::path>& files, run::Notices notices);

  // Returns what stands at a path: "/" is the page, "/rows/12" JSON with the rows that are new
  // since 12 changes, "/run/3" the page of a run of row 3, which is made for it; of the second
  // study "/b/rows/12" and "/b/run/3". A run that fails answers with status 500 and the error's
  // words.
  Reply get(std::string_view path);

 private:
  struct Study {
    explicit Study(const std::filesystem::path& file) : feed(file) {}

    StudyFeed feed;
    RowRuns runs;
    std::set<std::size_t> told;  // rows of whose folder there was a note
  };

  Reply page();
  Reply rows(Study& study, std::size_t known);
  Reply run_of(Study& study, std::size_t row);

  const run::Notices notices_;
  std::deque<Study> studies_;  // runs that go cannot be moved
};

}  // namespace sinew::live
