// recording/stated.h - value given for a whole file, in place of a column.
#pragma once

#include <string>
#include <vector>

#include "sinew/recording/recorded.h"

namespace sinew::recording {

// Value of "pressure=2 bar gauge", or "p200:pressure=2 bar gauge" for files with p200 in their
// name.
struct Stated {
  std::string part, name, value;

  // Returns whether the value applies to that file.
  bool is_for(const std::string& file) const;
};

// Parses such a text. Throws config::Error if the name or the value is missing.
Stated stated_in(const std::string& text);

// Adds a column for each value that applies to the file, with the name of its channel and the
// times of the first clock. Throws config::Error for a value that is not a number with a unit.
void add_stated(const std::vector<std::string>& values, Recorded& file);

// Throws config::Error if a value's part occurs in no file name, which is most likely a typing
// error.
void check_stated(const std::vector<std::string>& values, const std::vector<std::string>& files);

}  // namespace sinew::recording
