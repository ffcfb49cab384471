// config/rows.h - reader of the thesis's tables: lines of numbers with commas, without a heading.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::config {

std::string_view trimmed_row(std::string_view text);  // without blanks and carriage return

// Calls `row` with each line that is not blank, and its number.
void each_row(std::string_view text,
              const std::function<void(std::string_view line, int number)>& row);

// Text of a number, and its place.
struct Cell {
  std::string_view text;
  int column = 1;  // in the line
};
std::vector<Cell> cells_of(std::string_view line);  // split at the commas

}  // namespace sinew::config
