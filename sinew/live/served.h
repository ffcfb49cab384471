// live/served.h - what `sinew view` serves of what is there: runs, or a study.
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

struct Served {
  std::function<Reply(std::string_view path)> get;              // for a server
  std::function<std::string(const std::string& url)> in_words;  // what stands there
};

// `what`: the folder of a run, a log, or a study's file; empty: the runs below runs/, the newest
// first. `machine`: what was run, in place of a folder's resolved.toml; may be empty. Throws
// config::Error or log::Error where nothing of the kind is there.
Served served(const std::string& what, const std::string& machine, run::Notices notices = {});

// The same of several: none or one is as above, two studies' files stand beside each other.
Served served(const std::vector<std::string>& what, const std::string& machine,
              run::Notices notices = {});

// The pages of recorded runs, for a server: a list of them, each of them, and
// several beside each other.

// Returns the folders below `folder` with a log, the newest first.
std::vector<std::filesystem::path> runs_below(const std::filesystem::path& folder);

// Serves the pages of recorded runs.
class RunsPages {
 public:
  // `folder`: where runs are looked for, anew whenever the list is asked for; empty: nowhere.
  // `runs`: what is there by now, one at least; each keeps its number as long as this lives.
  // `machine`: what was run, in place of each resolved.toml; may be empty.
  RunsPages(std::filesystem::path folder, std::vector<std::filesystem::path> runs,
            std::string machine);

  // "/" is the list where `list_first()` was called, else the page of the first run. Besides:
  // "/runs" the list, "/run/3" the page of the run with that number, "/picture/3" a drawing of its
  // machine, "/compare/3,5" the page of those beside each other. A run that cannot be read answers
  // with status 500 and the error's words.
  Reply get(std::string_view path);
  void list_first() { list_first_ = true; }

  // Returns the runs by their numbers, as they were found so far.
  const std::vector<std::filesystem::path>& runs() const { return runs_; }

 private:
  // Holds what the list tells of a run, as JSON; kept until its files change.
  struct Told {
    std::filesystem::file_time_type written;
    std::string json;
  };

  void look_again();
  std::string told_of(std::size_t run);
  Reply list();
  Reply page_of_run(std::size_t run) const;
  Reply picture_of(std::size_t run) const;
  Reply compared(std::string_view numbers) const;

  const std::filesystem::path folder_;
  std::vector<std::filesystem::path> runs_;
  const std::string machine_;
  bool list_first_ = false;
  std::map<std::size_t, Told> told_;  // by the run's number
};

}  // namespace sinew::live
