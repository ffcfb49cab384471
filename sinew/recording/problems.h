// recording/problems.h - what is wrong with a table, collected: the first few of them are told.
#pragma once

#include <string>
#include <vector>

#include "sinew/config/diagnostics.h"

namespace sinew::recording {

class Problems {
 public:
  // Takes the name of the file that all of them are about.
  explicit Problems(std::string file) : file_(std::move(file)) {}

  // `line` 0: it is no line's.
  void add(int line, int column, std::string key, std::string found, std::string expected,
           std::string try_this = "");

  // Throws config::Error if there is one.
  void finish();

 private:
  std::string file_;
  std::vector<config::Problem> told_;
  std::size_t count_ = 0;
};

}  // namespace sinew::recording
