#include "sinew/recording/grid.h"

#include <fmt/format.h>

#include <algorithm>

#include "sinew/config/diagnostics.h"
#include "sinew/recording/text.h"

namespace sinew::recording {

namespace {

void check_word(const std::string& setting, const std::string& value,
                const std::vector<std::string_view>& words) {
  if (value.empty() || std::ranges::find(words, value) != words.end()) return;
  std::vector<std::string> quoted;
  for (const std::string_view word : words) quoted.push_back(config::in_quotes(word));
  const std::vector<std::string_view> names(quoted.begin(), quoted.end());
  config::fail({setting, 0, 0}, "", config::in_quotes(value), config::either(names),
               config::closest_in_quotes(value, words));
}

}  // namespace

void check_settings(const Source& source) {
  check_word("encoding", source.encoding, {"utf-8", "utf-16le", "utf-16be", "latin1"});
  check_word("decimal", source.decimal, {".", ","});
  check_word("thousands", source.thousands, {".", ",", " ", "'"});
  check_word("dates", source.dates, {"day first", "month first", "excel"});
  if (!source.thousands.empty() && source.thousands == source.decimal)
    config::fail({"thousands", 0, 0}, "", config::in_quotes(source.thousands) + ", as for decimals",
                 "two different signs", "one of them alone");
}

std::size_t Grid::rows_about() const {
  constexpr std::size_t some = 256 * 1024;
  const std::string_view body = std::string_view(*text).substr(dialect.body);
  const std::string_view begin = body.substr(0, some);
  const auto lines = static_cast<std::size_t>(std::count(begin.begin(), begin.end(), '\n')) + 1;
  if (begin.size() == body.size()) return lines;
  const double each = static_cast<double>(begin.size()) / static_cast<double>(lines);
  return static_cast<std::size_t>(1.02 * static_cast<double>(body.size()) / each);
}

Grid read_grid(std::string bytes, const Source& source) {
  check_settings(source);
  Text text = text_of_bytes(std::move(bytes), source.path, source.encoding);
  Grid grid{.file = source.path,
            .text = std::make_unique<const std::string>(std::move(text.utf8)),
            .dialect = {},
            .notes = std::move(text.notes)};
  grid.dialect = dialect_of(*grid.text, source);
  grid.read = source.read;
  grid.drop_incomplete = source.drop_incomplete;
  grid.notes.insert(grid.notes.end(), grid.dialect.notes.begin(), grid.dialect.notes.end());
  return grid;
}

Body::Body(const Grid& grid)
    : grid_(grid),
      reader_(*grid.text, grid.dialect.separator, grid.dialect.body, grid.dialect.body_line) {}

// Returns whether the row has as many cells as the header; removes empty cells at its end.
bool Body::fits(Row& row) {
  const std::size_t width = grid_.headings().size();
  while (row.cells.size() > width && row.cells.back().text.empty()) row.cells.pop_back();
  if (grid_.dialect.has_remarks && row.cells.size() + 1 == width) row.cells.push_back({});
  return row.cells.size() == width;
}

bool Body::next(Row& row) {
  while (reader_.next(row)) {
    if (grid_.read) grid_.read->store(static_cast<std::int64_t>(row.at), std::memory_order_relaxed);
    if (fits(row)) {
      ++count_;
      return true;
    }
    const std::size_t width = grid_.headings().size();
    if (is_date_line(row)) {
      ++dates_;
      continue;
    }
    if (row.cells.size() < width && count_ > 0 && reader_.at_end()) {
      cut_ = fmt::format("line {}, the last one, with {} of {} cells: left out", row.line,
                         row.cells.size(), width);
      return false;
    }
    if (ragged_++ > 0) continue;
    first_line_ = row.line;
    first_cells_ = row.cells.size();
    first_digits_ = static_cast<std::size_t>(std::ranges::count_if(row.cells, [](const Cell& c) {
      return !c.text.empty() && c.text.find_first_not_of("0123456789+-") == c.text.npos;
    }));
  }
  return false;
}

// Returns whether the rows that do not fit are longer because numbers were split at their decimal
// commas: a program replaced all semicolons by commas.
bool Body::is_cut_at_decimal_commas() const {
  const std::size_t width = grid_.headings().size();
  if (grid_.dialect.separator != ',' || first_cells_ <= width) return false;
  return first_cells_ == 2 * width || first_digits_ >= 2 * (first_cells_ - width);
}

void Body::finish(std::vector<std::string>& notes) const {
  if (!cut_.empty()) notes.push_back(cut_);
  if (dates_ > 0)
    notes.push_back(
        fmt::format("{} line{} with a date alone: left out", dates_, dates_ == 1 ? "" : "s"));
  if (ragged_ == 0) return;
  const std::size_t width = grid_.headings().size();
  const bool doubled = is_cut_at_decimal_commas();
  if (grid_.drop_incomplete && !(doubled && count_ == 0)) {
    notes.push_back(
        fmt::format("{} line{} with another number of cells than the {} of the header, "
                    "the first in line {}: left out",
                    ragged_, ragged_ == 1 ? "" : "s", width, first_line_));
    return;
  }
  config::fail(
      {grid_.file, first_line_, 1}, "row",
      fmt::format("{} cells ({} such row{})", first_cells_, ragged_, ragged_ == 1 ? "" : "s"),
      fmt::format("{} as in the header", width),
      doubled ? "decimal points, or semicolons between cells: with decimal commas every number is "
                "cut in two"
              : "drop_incomplete=true to leave such rows out");
}

}  // namespace sinew::recording
