// recording/clock.h - when the rows of a table were written: dates and times of day as seconds,
// and what is wrong with a clock that is none.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sinew/recording/grid.h"
#include "sinew/recording/problems.h"
#include "sinew/recording/stamp.h"

namespace sinew::recording {

// Does such a column hold instants, or a part of them?
bool tells_time(ColumnKind kind);

// Columns of dates and times of day, read row by row.
class StampClock {
 public:
  // `column` holds stamps, or dates or times of day whose other part stands in the first column of
  // that kind. Throws config::Error where nobody knows which of 11/03/2026 is the day.
  StampClock(const Grid& grid, const Source& source, std::size_t column);

  // Returns the instant since 1970, or since a midnight where there is no date  [ns]. Nothing where
  // a cell is no stamp; `cell` is that one.
  std::optional<std::int64_t> read(const Row& row, std::size_t& cell);

  // Returns whether the instants are since 1970; else they are since a midnight.
  bool has_dates() const { return dated_; }

  // Returns the zone of the first instant, local minus UTC  [ns]; nothing where no cell has one.
  std::optional<std::int64_t> zone() const { return zone_; }

  // Returns the columns that are read.
  const std::vector<std::size_t>& columns() const { return columns_; }

 private:
  void find_order(const Grid& grid, const Source& source);

  std::vector<std::size_t> columns_;
  DateOrder order_ = DateOrder::unknown;
  std::int64_t days_ = 0, last_ = 0;  // midnights that were passed; the last instant  [ns]
  bool first_ = true, dated_ = false;
  std::optional<std::int64_t> zone_;
};

// A column of whole seconds and one with the rest of each: header.stamp.sec, header.stamp.nanosec.
struct SplitSeconds {
  std::size_t seconds = 0, rest = 0;  // columns
  double unit = 1;                    // of the rest  [s]

  // Returns the time  [ns]; nothing if a cell holds no number, and `cell` is that one.
  std::optional<std::int64_t> read(const Row& row, NumberStyle style, std::size_t& cell) const;
};

// Returns the pair whose seconds are in `column`, or the first pair of the table without one. Its
// seconds are whole numbers, and the rest is below one second in each row.
std::optional<SplitSeconds> split_seconds(const Grid& grid,
                                          std::optional<std::size_t> column = std::nullopt);

// The columns of one clock, where a table has several: from the first up to, and without, the last.
struct ClockColumns {
  std::size_t clock = 0, from = 0, to = 0;
};

// Returns the columns of each clock, `clock` as the first of them; nothing where there is one
// clock. A clock without a column of numbers of its own is a column as any other.
std::vector<ClockColumns> clock_columns(const Grid& grid, std::optional<std::size_t> clock);

// Returns the time between rows  [s] that "100 Hz" or "10 ms" says. Throws config::Error.
double period_of_rate(const std::string& rate);

// Returns seconds since the first instant  [ns] -> [s].
std::vector<double> since_first(const std::vector<std::int64_t>& instants);

// Spreads rows that share a time evenly up to the next one, but no further than the clock's digits
// reach: the smallest step between two of its times. The first and the last time may have fewer
// rows than the others and have their step. Returns how many shared one.
std::size_t spread_times(std::vector<double>& time);

// Returns a note on rows of one time that became one.
std::string merged_text(std::size_t count);

// Adds a problem if a time is before the one above it.
void check_order(const std::vector<double>& time, const std::vector<int>& lines,
                 Problems& problems);

// Adds a problem if rows of different lines have the same time as the one above them.
void refuse_repeated(const std::vector<double>& time, const std::vector<int>& lines,
                     Problems& problems);

// What is to be known about a recording's clock before it is read.

// Says where the times are.
struct ClockSettings {
  std::string column;  // with the times; empty: `time`, or what else is clearly meant
  std::string unit;    // of its numbers; empty: the file's, or else s
  std::string rate;    // "100 Hz", in place of a column; empty: there is one
};

// Seconds of one step of the clock's unit; `file` is for the message. Throws config::Error where it
// is no unit of time.
double seconds_per_unit(const std::string& unit, const std::string& file);

}  // namespace sinew::recording
