// tune/results/merge.h - the files of one study's shares as one file.
#pragma once

#include <filesystem>
#include <vector>

namespace sinew::tune {

// Holds what came of putting files of one study together.
struct Merged {
  std::size_t points = 0;  // of the study
  std::size_t there = 0;   // those with a row in `to`
  std::size_t added = 0;
};

// Adds the rows of all files to `to`, which is made where it is missing: all of them, or none where
// it throws. Throws config::Error for files of different studies, for a point of which two rows
// differ in anything, and where `to` is one of the files; what Results and read_results() throw
// besides.
Merged merge(const std::vector<std::filesystem::path>& from, const std::filesystem::path& to);

}  // namespace sinew::tune
