#include "sinew/recording/clock.h"

#include <fmt/format.h>

#include <algorithm>

#include "sinew/config/quantity.h"
#include "sinew/config/spelling.h"

namespace sinew::recording {

namespace {

constexpr std::int64_t one_day = 86400LL * 1'000'000'000;  // [ns]

}  // namespace

bool tells_time(ColumnKind kind) {
  return kind == ColumnKind::stamps || kind == ColumnKind::dates ||
         kind == ColumnKind::times_of_day;
}

StampClock::StampClock(const Grid& grid, const Source& source, std::size_t column)
    : columns_{column} {
  const std::vector<ColumnKind>& kinds = grid.dialect.kinds;
  const ColumnKind kind = kinds[column];
  if (kind != ColumnKind::stamps) {
    const ColumnKind other =
        kind == ColumnKind::dates ? ColumnKind::times_of_day : ColumnKind::dates;
    const auto found = std::ranges::find(kinds, other);
    if (found != kinds.end()) columns_.push_back(static_cast<std::size_t>(found - kinds.begin()));
  }
  find_order(grid, source);
}

// One date whose first number is above 12 tells the order of all.
void StampClock::find_order(const Grid& grid, const Source& source) {
  if (source.dates == "day first") order_ = DateOrder::day_first;
  if (source.dates == "month first") order_ = DateOrder::month_first;
  if (order_ != DateOrder::unknown) return;
  Body body(grid);
  Row row;
  std::string_view doubtful;
  int line = 0;
  while (body.next(row)) {
    for (const std::size_t column : columns_) {
      const std::string_view text = row.cells[column].text;
      const auto stamp = stamp_in(text);
      if (!stamp || !stamp->has_date) continue;
      if (stamp->order != DateOrder::unknown) return;  // and so all of them say it
      if (stamp->first > 12) order_ = DateOrder::day_first;
      if (stamp->second > 12) order_ = DateOrder::month_first;
      if (order_ != DateOrder::unknown) return;
      if (!doubtful.empty() || stamp->first == stamp->second) continue;
      doubtful = text;
      line = row.line;
    }
  }
  order_ = DateOrder::day_first;  // days and months that are the same number
  if (doubtful.empty()) return;
  config::fail({grid.file, line, 1}, grid.headings()[columns_[0]].name,
               fmt::format("{}, and no date whose day is above 12", config::in_quotes(doubtful)),
               "dates that show which number is the day",
               "dates=\"day first\" or dates=\"month first\"");
}

std::optional<std::int64_t> StampClock::read(const Row& row, std::size_t& cell) {
  std::int64_t instant = 0, offset = 0;
  bool dated = false;
  for (const std::size_t column : columns_) {
    cell = column;
    const auto stamp = stamp_in(row.cells[column].text);
    if (!stamp) return std::nullopt;
    if (stamp->has_date) {
      const auto days = days_of(*stamp, order_);
      if (!days) return std::nullopt;
      instant += *days * one_day;
      dated = true;
    }
    instant += stamp->time;
    offset += stamp->offset;
  }
  // A time of day alone begins anew at midnight.
  if (!dated && !first_ && instant + days_ < last_ - one_day / 2) days_ += one_day;
  instant += days_;
  last_ = instant;
  if (first_) {
    const std::string text = iso_text(instant);
    start_ = dated ? text : text.substr(text.find('T') + 1);
    first_ = false;
  }
  return instant - offset;
}

double period_of_rate(const std::string& rate) {
  const std::size_t number = rate.find_first_not_of("0123456789.+-eE");
  std::string text = rate;
  if (number != std::string::npos) {
    const auto unit = config::spellings(std::string_view(rate).substr(number));
    if (!unit.empty() && unit.front().factor == 1)
      text = rate.substr(0, number) + " " + unit.front().unit;
  }
  const config::Parsed frequency = config::parse_quantity(text, "Hz");
  const config::Parsed period = config::parse_quantity(text, "s");
  const double value = !period.mistake ? period.si : frequency.mistake ? 0 : 1 / frequency.si;
  if (value > 0 && value < 1e9) return value;
  config::fail({"rate", 0, 0}, "", config::in_quotes(rate),
               "how many rows there are in a second, or the time between two",
               "\"100 Hz\" or \"10 ms\"");
}

std::vector<double> since_first(const std::vector<std::int64_t>& instants) {
  std::vector<double> out;
  out.reserve(instants.size());
  for (const std::int64_t instant : instants)
    out.push_back(static_cast<double>(instant - instants.front()) / 1e9);
  return out;
}

std::size_t spread_times(std::vector<double>& time) {
  std::size_t shared = 0;
  double step = 0;  // of the last group's rows
  for (std::size_t from = 0; from < time.size();) {
    std::size_t to = from + 1;
    while (to < time.size() && time[to] == time[from]) ++to;
    const auto count = static_cast<double>(to - from);
    if (to < time.size()) step = (time[to] - time[from]) / count;
    for (std::size_t i = from + 1; i < to; ++i)
      time[i] = time[from] + step * static_cast<double>(i - from);
    shared += to - from - 1;
    from = to;
  }
  return shared;
}

void check_order(const std::vector<double>& time, const std::vector<int>& lines,
                 Problems& problems) {
  const auto back = std::is_sorted_until(time.begin(), time.end());
  if (back == time.end()) return;
  const auto row = static_cast<std::size_t>(back - time.begin());
  problems.add(lines[row], 1, "time", fmt::format("{} s after {} s", time[row], time[row - 1]),
               "times that do not run backwards",
               "to sort the rows by their time, or a file for each recorder's own rows");
}

void refuse_repeated(const std::vector<double>& time, const std::vector<int>& lines,
                     Problems& problems) {
  std::size_t count = 0, first = 0;
  for (std::size_t i = 1; i < time.size(); ++i) {
    if (time[i] != time[i - 1] || lines[i] == lines[i - 1]) continue;  // a line may give many rows
    if (count++ == 0) first = i;
  }
  if (count == 0) return;
  problems.add(lines[first], 1, "time",
               fmt::format("{} rows with the time of the row above, as the clock is coarse", count),
               "a time of its own for each row",
               "spread_times=true to spread such rows evenly up to the next time");
}

}  // namespace sinew::recording
