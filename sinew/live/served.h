// live/served.h - pages of existing files for `sinew view`, runs or studies, and the user's
// browser.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/live/server.h"
#include "sinew/run/folder/notices.h"

namespace sinew::live {

// Opens an address in the browser if there is a graphical session and the address is not "". All
// users of the computer can read the arguments of a command, and the address has a secret token.
// The browser is therefore given a file that only its user may read and that redirects to the
// address. The file is removed by the destructor.
class Browser {
 public:
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
