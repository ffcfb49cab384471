// live/study_feed.h - a study's file as it grows: what is new in it since somebody asked.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <vector>

#include "sinew/tune/page/study_view.h"

namespace sinew::live {

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

}  // namespace sinew::live
