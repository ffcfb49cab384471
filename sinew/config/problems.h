// config/problems.h - collection of the faults of a file; the first few are reported.
#pragma once

#include <string>
#include <vector>

#include "sinew/config/diagnostics.h"

namespace sinew::config {

class Problems {
 public:
  // Takes the name of the file that has the faults.
  explicit Problems(std::string file) : file_(std::move(file)) {}

  // Adds a fault; `line` 0: it belongs to no line.
  void add(int line, int column, std::string key, std::string found, std::string expected,
           std::string try_this = "");

  // Throws Error if there are any faults.
  void finish();

 private:
  std::string file_;
  std::vector<Problem> problems_;
  std::size_t count_ = 0;
};

}  // namespace sinew::config
