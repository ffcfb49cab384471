// config/rows.h - the thesis's tables: lines of numbers with commas, without a heading.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/config/diagnostics.h"

namespace sinew::config {

std::string_view trimmed_row(std::string_view text);  // without blanks and carriage return

// A number's text, and where it stands.
struct Cell {
  std::string_view text;
  int column = 1;  // of the line
};
std::vector<Cell> cells_of(std::string_view line);  // at the commas

// Collects what is wrong, row by row; stops talking after a handful.
class RowProblems {
 public:
  // `name` is the file's, for the words.
  explicit RowProblems(std::string name) : name_(std::move(name)) {}

  // Keeps one thing that is wrong.
  void add(int line, int column, std::string_view key, std::string found, std::string expected,
           std::string try_this = "");
  // Throws Error if there is any.
  void finish() const {
    if (!problems_.empty()) throw Error(problems_);
  }

 private:
  std::string name_;
  std::vector<Problem> problems_;
};

}  // namespace sinew::config
