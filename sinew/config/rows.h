// config/rows.h - reader of the thesis's tables: lines of numbers with commas, without a heading.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/config/diagnostics.h"

namespace sinew::config {

std::string_view trimmed_row(std::string_view text);  // without blanks and carriage return

// Text of a number, and its place.
struct Cell {
  std::string_view text;
  int column = 1;  // in the line
};
std::vector<Cell> cells_of(std::string_view line);  // split at the commas

// Collects the faults of rows; keeps only the first few.
class RowProblems {
 public:
  // `name` is the file's, for messages.
  explicit RowProblems(std::string name) : name_(std::move(name)) {}

  // Adds a fault.
  void add(int line, int column, std::string_view key, std::string found, std::string expected,
           std::string try_this = "");
  // Throws Error if there are any faults.
  void finish() const {
    if (!problems_.empty()) throw Error(problems_);
  }

 private:
  std::string name_;
  std::vector<Problem> problems_;
};

}  // namespace sinew::config
