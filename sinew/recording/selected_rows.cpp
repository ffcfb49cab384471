#include "sinew/recording/selected_rows.h"

#include <fmt/format.h>

#include <cmath>

#include "sinew/config/setting.h"
#include "sinew/recording/columns.h"
#include "sinew/units/letters.h"

namespace sinew::recording {

namespace {

// Takes the cells that `to` lacks.
void take_cells(Row& from, Row& to) {
  for (std::size_t i = 0; i < to.cells.size(); ++i)
    if (is_missing(to.cells[i].text)) to.cells[i] = from.cells[i];
  for (auto& text : from.mended) to.mended.push_back(std::move(text));
  from.mended.clear();
}

}  // namespace

SelectedRows::SelectedRows(const Grid& grid, const Source& source, RowClock& clock,
                           std::vector<std::size_t> columns, config::Problems& problems,
                           const std::optional<ClockColumns>& only)
    : grid_(grid),
      source_(source),
      clock_(clock),
      problems_(problems),
      only_(only),
      columns_(std::move(columns)),
      body_(grid) {
  check_columns(grid.header(), "where", source.where, problems);
  for (const auto& [name, values] : source.where)
    if (const auto column = grid.header().find(name))
      where_.emplace_back(*column, config::at_commas(values));
}

bool SelectedRows::next() {
  const auto read = [this] {
    do {
      has_next_ = body_.next(next_);
    } while (has_next_ && has_ended(next_));
    next_index_ = body_.count() - 1;
    return has_next_;
  };
  if (body_.count() == 0) read();
  while (has_next_) {
    std::swap(row_, next_);
    index_ = next_index_;
    while (read() && fills(row_, next_)) {
      take_cells(next_, row_);
      ++merged_;
    }
    if (meets_conditions(row_)) return true;
  }
  return false;
}

bool SelectedRows::fills(const Row& above, const Row& row) const {
  const auto text = [](const Row& of, std::size_t i) { return of.cells[i].text; };
  if (clock_.kind() == RowClock::Kind::none || clock_.kind() == RowClock::Kind::rate) return false;
  for (const std::size_t i : clock_.columns())
    if (text(above, i) != text(row, i) || is_missing(text(row, i))) return false;
  const auto one_is_missing = [&](std::size_t i) {
    return is_missing(text(above, i)) || is_missing(text(row, i));
  };
  return std::ranges::all_of(columns_, one_is_missing) &&
         std::ranges::all_of(where_, [&](const auto& condition) {
           const std::size_t i = condition.first;
           return one_is_missing(i) || text(above, i) == text(row, i);
         });
}

bool SelectedRows::meets_conditions(const Row& row) const {
  return std::ranges::all_of(where_, [&](const auto& condition) {
    const std::string_view cell = row.cells[condition.first].text;
    const auto number = number_in(cell, grid_.dialect.numbers);
    return std::ranges::any_of(condition.second, [&](const std::string& value) {
      const auto wanted = number_in(units::trimmed(value));
      return number && wanted ? *number == *wanted : cell == units::trimmed(value);
    });
  });
}

bool SelectedRows::has_ended(const Row& row) const {
  for (std::size_t i = only_ ? only_->from : 0; only_ && i < only_->to; ++i)
    if (!is_missing(row.cells[i].text)) return false;
  return only_.has_value();
}

std::optional<RowTime> SelectedRows::time() {
  std::size_t cell = 0;
  if (const auto time = clock_.read(row_, index_, cell)) return time;
  if (is_missing_allowed(cell, "time", clock_.expected(), false, false))
    return RowTime{.number = no_value};
  return std::nullopt;
}

std::optional<double> SelectedRows::number(std::size_t column, std::string_view name, bool may_miss,
                                           NumberWords words) {
  const std::string_view text = row_.cells[column].text;
  const auto number = number_in(text, grid_.dialect.numbers);
  if (number && std::isfinite(*number)) return number;
  for (const auto& [word, meant] : words)
    if (text == word) return meant;
  if (may_miss && is_missing(text)) return no_value;
  std::string expected = may_miss ? "a number" : "a finite number";
  for (const auto& [word, meant] : words)
    expected += fmt::format(" or {}", config::in_quotes(word));
  if (is_missing_allowed(column, name, expected, may_miss, !words.empty())) return no_value;
  return std::nullopt;
}

// Returns whether the row may do without a number in the cell; else adds a fault.
bool SelectedRows::is_missing_allowed(std::size_t column, std::string_view name,
                                      const std::string& expected, bool may_miss, bool has_words) {
  const Cell& cell = row_.cells[column];
  const std::string hint = hint_for(cell.text, grid_.dialect.numbers);
  const bool is_none = is_missing(cell.text) || number_in(cell.text, grid_.dialect.numbers) ||
                       (source_.drop_incomplete && hint.empty() && !has_words);
  if (is_none && (may_miss || source_.drop_incomplete)) return true;
  problems_.add(row_.line, cell.column, std::string(name),
                cell.text.empty() ? "an empty cell" : config::in_quotes(cell.text), expected,
                is_none ? "drop_incomplete=true to leave such rows out" : hint);
  return false;
}

std::size_t SelectedRows::finish(std::vector<std::string>& notes) const {
  body_.finish(notes);
  if (merged_ > 0)
    notes.push_back(
        fmt::format("{} rows have the time of the row above and values of other "
                    "columns: merged with it",
                    merged_));
  return body_.count();
}

}  // namespace sinew::recording
