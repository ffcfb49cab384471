#include "sinew/config/valve_timing.h"

#include <fmt/format.h>

#include <charconv>
#include <sstream>
#include <vector>

#include "sinew/config/diagnostics.h"
#include "sinew/config/rows.h"
#include "sinew/config/text_file.h"

namespace sinew::config {

namespace {

constexpr int columns = 3;
constexpr std::array<std::string_view, columns> column_names = {"duty", "close", "open"};

using Row = std::array<int, columns>;

bool parse_row(std::string_view text, int line, Row& row, Problems& problems) {
  const std::vector<Cell> cells = cells_of(text);
  if (cells.size() != columns) {
    problems.add(line, 1, "", fmt::format("{} columns", cells.size()), "duty,close,open",
                 "a comma between whole numbers");
    return false;
  }
  for (std::size_t i = 0; i < columns; ++i) {
    const auto& [cell, column] = cells[i];
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), row[i]);
    if (error != std::errc{} || end != cell.data() + cell.size()) {
      problems.add(line, column, std::string(column_names[i]), in_quotes(cell),
                   "a whole number of ticks");
      return false;
    }
  }
  return true;
}

// Compares a row with the one above: the duty counts up, and a larger duty never closes earlier.
void check_row(const Row& row, int line, int duty, const Row& last, Problems& problems) {
  if (row[0] != duty) {
    problems.add(line, 1, "duty", std::to_string(row[0]), std::to_string(duty),
                 "one row per percent, 0 to 100 in order");
  }
  for (std::size_t i = 1; i < columns; ++i) {
    if (row[i] >= 0 && row[i] <= ValveTiming::never) continue;
    problems.add(line, 1, std::string(column_names[i]), std::to_string(row[i]),
                 fmt::format("0 to {} ticks", ValveTiming::never),
                 fmt::format("{} for never", ValveTiming::never));
  }
  // Otherwise inlet and exhaust of one muscle could be open at the same time.
  if (duty == 0 && (row[1] > 1 || row[2] < ValveTiming::never)) {
    problems.add(line, 1, row[1] > 1 ? "close" : "open",
                 fmt::format("{} at duty 0, which does not shut at once and stay shut",
                             row[1] > 1 ? row[1] : row[2]),
                 row[1] > 1 ? "0 or 1" : fmt::format("{} for never", ValveTiming::never));
  }
  if (row[1] < last[1]) {
    problems.add(line, 1, "close", fmt::format("{} after {}", row[1], last[1]),
                 "a closing tick that does not fall as the duty rises");
  }
  if (row[2] > last[2] && row[2] <= ValveTiming::never) {
    problems.add(line, 1, "open", fmt::format("{} after {}", row[2], last[2]),
                 "an opening tick that does not rise as the duty rises");
  }
}

}  // namespace

ValveTiming parse_valve_timing(std::string_view text, const std::string& name) {
  ValveTiming timing;
  Problems problems(name);
  std::istringstream lines{std::string(text)};
  std::string line_text;
  int line = 0, duty = 0;
  Row last = {0, 0, ValveTiming::never};
  while (std::getline(lines, line_text)) {
    ++line;
    if (trimmed_row(line_text).empty()) continue;
    if (duty == ValveTiming::rows) {
      problems.add(line, 1, "", "a row more", fmt::format("{} rows", ValveTiming::rows));
      break;
    }
    Row row{};
    if (parse_row(line_text, line, row, problems)) {
      check_row(row, line, duty, last, problems);
      last = row;
      const auto index = static_cast<std::size_t>(duty);
      timing.closing[index] = static_cast<std::uint16_t>(row[1]);
      timing.opening[index] = static_cast<std::uint16_t>(row[2]);
    }
    ++duty;
  }
  if (duty < ValveTiming::rows) {
    problems.add(line, 1, "", fmt::format("{} rows of {}", duty, ValveTiming::rows),
                 fmt::format("{} rows, duty 0 to 100", ValveTiming::rows),
                 "a fresh copy: this one is cut short");
  }
  problems.finish();
  return timing;
}

ValveTiming read_valve_timing(const std::string& path) {
  return parse_valve_timing(read_text_file(path, "a table duty,close,open"), path);
}

}  // namespace sinew::config
