// config/problems.h - collection of the faults of a file.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sinew/config/diagnostics.h"

namespace sinew::config {

class Problems {
 public:
  // Takes the name of the file that has the faults. A file of many rows reports the first `most`
  // and the number of the others.
  explicit Problems(std::string file, std::size_t most = 8) : file_(std::move(file)), most_(most) {}

  // Adds a fault; `line` 0: it belongs to no line.
  void add(int line, int column, std::string key, std::string found, std::string expected,
           std::string try_this = "");
  // Adds a fault of any file.
  void add(Problem problem);

  // Returns the number of faults.
  std::size_t count() const { return count_; }

  // Throws Error if there are any faults.
  void finish();

 private:
  std::string file_;
  std::size_t most_;
  std::vector<Problem> problems_;
  std::size_t count_ = 0;
};

}  // namespace sinew::config
