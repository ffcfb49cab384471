// live/study_pages.h - the page of a study that may still grow, or of two beside each other, and of
// runs of their rows, for a server.
#pragma once

#include <deque>
#include <filesystem>
#include <set>
#include <string_view>
#include <vector>

#include "sinew/live/row_runs.h"
#include "sinew/live/server.h"
#include "sinew/live/study_feed.h"
#include "sinew/run/folder/notices.h"

namespace sinew::live {

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
