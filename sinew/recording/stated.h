// recording/stated.h - a value that is stated for a whole file, in place of a column.
#pragma once

#include <string>
#include <vector>

#include "sinew/recording/recorded.h"

namespace sinew::recording {

// "pressure=2 bar gauge", or of files with a part in their name "p200:pressure=2 bar gauge".
struct Stated {
  std::string part, name, value;

  // Returns whether it is one of that file's.
  bool is_for(const std::string& file) const;
};

// Throws config::Error for a text that has no name or no value.
Stated stated_in(const std::string& text);

// Adds a column for each value of that file, called as its channel, with the times of its first
// clock. Throws config::Error for a value other than a number with a unit.
void add_stated(const std::vector<std::string>& values, Recorded& file);

// Throws config::Error where the part of a value is in the name of no file: a slip.
void check_stated(const std::vector<std::string>& values, const std::vector<std::string>& files);

}  // namespace sinew::recording
