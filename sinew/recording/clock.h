// recording/clock.h - clocks of a table: conversion of dates and times of day to seconds, and
// checks of a table's times.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/config/diagnostics.h"
#include "sinew/recording/grid.h"
#include "sinew/recording/stamp.h"

namespace sinew::recording {

// Continues a counter of 8, 16, 24, 32, 53 or 64 bits, signed or unsigned, after an overflow. Its
// numbers may be in thousandths, millionths or billionths: micros() / 1000 restarts at 4294967.296
// ms.
class Unwrapper {
 public:
  // Returns the time as a counter without overflow would show it. A step back counts as an overflow
  // only if a power of two explains it to within one sample; other steps back are left as they are.
  double operator()(double time);

  // Returns the number of overflows.
  std::size_t wraps() const { return wraps_; }
  int bits() const { return bits_; }  // width of the counter, after the first overflow

 private:
  std::optional<double> range_of(double time) const;

  double added_ = 0, last_ = 0, step_ = 0;  // in the file's numbers
  std::size_t count_ = 0, wraps_ = 0;
  mutable int bits_ = 0;
};

// Returns a note about a clock's counter that overflowed.
std::string wraps_text(std::string_view column, const Unwrapper& clock);

// Returns whether a column of this kind holds instants, dates or times of day.
bool holds_time(ColumnKind kind);

// Columns of dates and times of day, read row by row.
class StampClock {
 public:
  // Uses the stamps in `column`, or its dates or times of day together with the first column of the
  // other kind. Throws config::Error if the order of day and month is ambiguous, as in 11/03/2026.
  StampClock(const Grid& grid, const Source& source, std::size_t column);

  // Returns the instant since 1970, or since a midnight where there is no date [ns]. Returns
  // nothing if a cell does not hold a stamp; `cell` is then its index.
  std::optional<std::int64_t> read(const Row& row, std::size_t& cell);

  // Returns whether the instants are since 1970; else they are since a midnight.
  bool has_dates() const { return dated_; }

  // Returns the zone of the first instant, local minus UTC  [ns]; nothing if no cell has one.
  std::optional<std::int64_t> zone() const { return zone_; }

  // Returns the columns that are read.
  const std::vector<std::size_t>& columns() const { return columns_; }

 private:
  void find_order(const Grid& grid, const Source& source);

  std::vector<std::size_t> columns_;
  DateOrder order_ = DateOrder::unknown;
  std::int64_t days_ = 0, last_ = 0;  // midnights that were passed; last instant  [ns]
  bool first_ = true, dated_ = false;
  std::optional<std::int64_t> zone_;
};

// A column of whole seconds and one with the rest of each: header.stamp.sec, header.stamp.nanosec.
struct SplitSeconds {
  std::size_t seconds = 0, rest = 0;  // columns
  double unit = 1;                    // the unit of `rest`  [s]

  // Returns the time [ns]; returns nothing if a cell does not hold a finite number, and `cell` is
  // then its index.
  std::optional<std::int64_t> read(const Row& row, NumberStyle style, std::size_t& cell) const;
};

// Returns the pair whose seconds are in `column`, or without `column` the table's first pair. Its
// seconds are whole numbers, and the rest is below one second in each row.
std::optional<SplitSeconds> split_seconds(const Grid& grid,
                                          std::optional<std::size_t> column = std::nullopt);

// Time of a row, as the table's clock counts it; it is missing if `number` is NaN.
struct RowTime {
  double number = 0;         // in the clock's unit; a rate counts in s
  std::int64_t instant = 0;  // instant, for a clock of instants [ns]
};

// Clock of a table's rows: a rate, or columns of numbers, of seconds and their rest, or of dates
// and times of day.
class RowClock {
 public:
  // Source of the times: nothing, a rate, numbers of a column, or dates with times of day.
  enum class Kind { none, rate, numbers, instants };

  // Makes a clock without times.
  RowClock() = default;
  // Uses the source's rate, else the rate of the header or the times in `column`. Throws
  // config::Error like StampClock.
  RowClock(const Grid& grid, const Source& source, std::optional<std::size_t> column);

  // Returns the time of the row, the `index`-th one of the table. Returns nothing if a cell does
  // not hold a time; `cell` is then its index.
  std::optional<RowTime> read(const Row& row, std::size_t index, std::size_t& cell);

  // Forgets the rows before the next one.
  void restart() { unwrap_ = {}; }

  // Returns the source of the times.
  Kind kind() const { return kind_; }
  double period() const { return period_; }  // between two rows [s]; 0: no rate
  // Return the dates and times of day, and the seconds in two columns, if the clock has them.
  const std::optional<StampClock>& stamps() const { return stamps_; }
  const std::optional<SplitSeconds>& split() const { return split_; }
  // Returns the columns with the times.
  const std::vector<std::size_t>& columns() const { return columns_; }
  // Returns a description of the cells with times, for messages.
  const char* expected() const;
  // Adds a note about a counter that overflowed.
  void note_wraps(std::string_view column, std::vector<std::string>& notes) const;

 private:
  Kind kind_ = Kind::none;
  double period_ = 0;
  std::optional<StampClock> stamps_;
  std::optional<SplitSeconds> split_;
  std::vector<std::size_t> columns_;
  NumberStyle style_;
  Unwrapper unwrap_;
};

// Columns of one clock, where a table has several: [from, to).
struct ClockColumns {
  std::size_t clock = 0, from = 0, to = 0;
};

// Returns the columns of each clock, where `clock` is the first clock's column. Returns nothing if
// the table has one clock. Each clock must have a column of numbers, else it is an ordinary column.
std::vector<ClockColumns> clock_columns(const Grid& grid, std::optional<std::size_t> clock);

// Returns the time between rows [s] for a text such as "100 Hz" or "10 ms". Throws config::Error.
double period_of_rate(const std::string& rate);

// Returns seconds since the first instant  [ns] -> [s].
std::vector<double> since_first(const std::vector<std::int64_t>& instants);

// Spreads rows that share a time evenly up to the next time, but no further than the clock's
// resolution: the smallest step between two times. The first and the last time may have fewer rows
// than the others, which are then spread with the usual step. Returns the number of rows that
// shared a time.
std::size_t spread_times(std::vector<double>& time);

// Adds a problem if a time is before the one above it.
void check_order(const std::vector<double>& time, const std::vector<int>& lines,
                 config::Problems& problems);

// Adds a problem if rows of different lines have the same time as the one above them.
void refuse_repeated(const std::vector<double>& time, const std::vector<int>& lines,
                     config::Problems& problems);

}  // namespace sinew::recording
