// live/study_pages.h - the page of a study that may still grow, and of runs of its rows, for a
// server.
#pragma once

#include <filesystem>
#include <set>
#include <string_view>

#include "sinew/live/row_runs.h"
#include "sinew/live/server.h"
#include "sinew/live/study_feed.h"
#include "sinew/run/folder/notices.h"

namespace sinew::live {

class StudyPages {
 public:
  // Throws as tune::study_view() does, and std::runtime_error where the library was built without
  // its pages.
  StudyPages(const std::filesystem::path& file, run::Notices notices);

  // Returns what stands at a path: "/" is the page, "/rows/12" JSON with the rows that are new
  // since 12 changes, "/run/3" the page of a run of row 3, which is made for it. A run that fails
  // answers with status 500 and the error's words.
  Reply get(std::string_view path);

 private:
  Reply page();
  Reply rows(std::size_t known);
  Reply run_of(std::size_t row);

  const run::Notices notices_;
  StudyFeed feed_;
  RowRuns runs_;
  std::set<std::size_t> told_;  // rows of whose folder there was a note
};

}  // namespace sinew::live
