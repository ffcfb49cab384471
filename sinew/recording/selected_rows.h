// recording/selected_rows.h - rows of a table that meet the source's conditions, with their times
// and numbers.
//
//   SelectedRows rows(grid, source, clock, columns, problems);
//   while (rows.next()) rows.number(column, name);
//   rows.finish(notes);
//
// Rows of equal time that fill each other's empty cells are merged: the logger wrote a line for
// each of its channels. Cells of a condition may also be equal.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sinew/config/diagnostics.h"
#include "sinew/recording/clock.h"
#include "sinew/recording/grid.h"

namespace sinew::recording {

// Number of a cell that is missing.
inline constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

// Words of a column that mean numbers.
using NumberWords = std::span<const std::pair<std::string_view, double>>;

class SelectedRows {
 public:
  // Keeps references to grid, source, clock and problems, which must outlive this object. `columns`
  // are read besides the clock's. With `only`, rows without a cell of that clock are left out: its
  // columns may be shorter than the others.
  SelectedRows(const Grid& grid, const Source& source, RowClock& clock,
               std::vector<std::size_t> columns, config::Problems& problems,
               const std::optional<ClockColumns>& only = {});

  // Goes to the next row; returns false after the last one.
  bool next();
  const Row& row() const { return row_; }

  // Returns the time of the row: NaN if it is missing and the row is to be left out; nothing after
  // a fault, which is added to the problems.
  std::optional<RowTime> time();

  // Returns the number in a cell, or the one that a word means. NaN: it is missing, which is
  // allowed if `may_miss` is set or incomplete rows are dropped. Nothing after a fault, which is
  // added to the problems under `name`.
  std::optional<double> number(std::size_t column, std::string_view name, bool may_miss,
                               NumberWords words = {});

  // Adds the notes of the rows, and returns their number. Throws config::Error like Body.
  std::size_t finish(std::vector<std::string>& notes) const;

 private:
  bool fills(const Row& above, const Row& row) const;
  bool meets_conditions(const Row& row) const;
  bool has_ended(const Row& row) const;
  bool is_missing_allowed(std::size_t column, std::string_view name, const std::string& expected,
                          bool may_miss, bool has_words);

  const Grid& grid_;
  const Source& source_;
  RowClock& clock_;
  config::Problems& problems_;
  std::optional<ClockColumns> only_;
  std::vector<std::size_t> columns_;  // must not differ in merged rows
  std::vector<std::pair<std::size_t, std::vector<std::string>>> where_;  // a column, its values
  Body body_;
  Row row_, next_;  // `next_` is read, but not yet merged
  std::size_t index_ = 0, next_index_ = 0, merged_ = 0;
  bool has_next_ = false;
};

}  // namespace sinew::recording
