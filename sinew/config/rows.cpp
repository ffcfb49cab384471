#include "sinew/config/rows.h"

#include <algorithm>

namespace sinew::config {

std::string_view trimmed_row(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

void each_row(std::string_view text,
              const std::function<void(std::string_view line, int number)>& row) {
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (!trimmed_row(text.substr(0, end)).empty()) row(text.substr(0, end), number);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

std::vector<Cell> cells_of(std::string_view line) {
  std::vector<Cell> cells;
  for (std::size_t start = 0; start <= line.size();) {
    const std::size_t comma = std::min(line.find(',', start), line.size());
    const std::string_view cell = trimmed_row(line.substr(start, comma - start));
    const std::size_t at =
        cell.empty() ? start : static_cast<std::size_t>(cell.data() - line.data());
    cells.push_back({cell, static_cast<int>(at) + 1});
    start = comma + 1;
  }
  return cells;
}

}  // namespace sinew::config
