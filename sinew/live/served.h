// live/served.h - pages of existing files for `sinew view`, runs or studies, and the user's
// browser.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <functional>
#include <future>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/live/server.h"
#include "sinew/run/folder/notices.h"
#include "sinew/tune/page/study_view.h"

namespace sinew::live {

// Page of one or two studies that may still grow, and of runs of their rows, for a server.

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

// The page of a study, or of two, in a browser: the rows that each request finds in the files.
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

// Opens an address in the browser if there is a graphical session and the address is not "". All
// users of the computer can read the arguments of a command, and the address has a secret token.
// The browser is therefore given a file that only its user may read and that redirects to the
// address. The file is removed by the destructor.
class Browser {
 public:
  // Opens the address.
  explicit Browser(const std::string& url);
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

 private:
  std::filesystem::path redirecting_page_;
};

struct Served {
  std::function<Reply(std::string_view path)> get;                 // for a server
  std::function<std::string(const std::string& url)> description;  // description of the pages
};

// Returns the pages of `what`: the folder of a run, a log, or a study's file; empty: the runs below
// runs/, the newest first. `machine` is a file used instead of a run's resolved.toml; it may be
// empty. Throws config::Error or log::Error if nothing is found.
Served served(const std::string& what, const std::string& machine, run::Notices notices = {});

// Returns the pages of several files: none or one as above, or two studies on one page.
Served served(const std::vector<std::string>& what, const std::string& machine,
              run::Notices notices = {});

// --- Recorded runs: a list of them, each of them, and comparisons ---

// Returns the folders below `folder` with a log, the newest first.
std::vector<std::filesystem::path> runs_below(const std::filesystem::path& folder);

// Serves the pages of recorded runs.
class RunsPages {
 public:
  // `folder` is searched for runs whenever the list is requested; empty: it is not. `runs` are
  // those that exist now, at least one; each keeps its number during the lifetime of this object.
  // `machine` is a file used instead of each resolved.toml; it may be empty.
  RunsPages(std::filesystem::path folder, std::vector<std::filesystem::path> runs,
            std::string machine);

  // Returns the page at a path: "/" is the list if list_first() was called, else the page of the
  // first run; "/runs" is the list, "/run/3" the page of run 3, "/picture/3" a drawing of its
  // machine, "/compare/3,5" the comparison of two to eight runs. A run that cannot be read gives
  // status 500 with the error's message.
  Reply get(std::string_view path);
  void list_first() { list_first_ = true; }

  // Returns the runs found so far, by their numbers.
  const std::vector<std::filesystem::path>& runs() const { return runs_; }

 private:
  // Entry of the list for a run, as JSON; cached until its files change.
  struct ListEntry {
    std::filesystem::file_time_type written;
    std::string json;
  };

  void find_new_runs();
  std::string entry_of(std::size_t run);
  Reply list();
  Reply page_of_run(std::size_t run) const;
  Reply picture_of(std::size_t run) const;
  Reply compared(std::string_view numbers) const;

  const std::filesystem::path folder_;
  std::vector<std::filesystem::path> runs_;
  const std::string machine_;
  bool list_first_ = false;
  std::map<std::size_t, ListEntry> entries_;  // key: number of the run
};

}  // namespace sinew::live
