#include "sinew/recording/clock.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sinew/units/quantity.h"
#include "sinew/units/spelling.h"

namespace sinew::recording {

double Unwrapper::operator()(double time) {
  if (count_ > 1 && time < last_) {
    if (const std::optional<double> range = range_of(time)) {
      added_ += *range;
      ++wraps_;
      last_ = time;  // the step stays that before the wrap
      return time + added_;
    }
  }
  if (count_ > 0 && time != last_) step_ = time - last_;
  ++count_;
  last_ = time;
  return time + added_;
}

// Returns the counter's range if it was near its end before the step back and is near its start
// now.
std::optional<double> Unwrapper::range_of(double time) const {
  constexpr int widths[] = {8, 16, 24, 32, 53, 64};
  constexpr double units[] = {1, 1e-3, 1e-6, 1e-9};
  if (!(step_ > 0)) return std::nullopt;
  for (const int bits : widths) {
    for (const double unit : units) {
      const double range = std::ldexp(unit, bits);
      const bool as_far = std::abs(range - (last_ - time) - step_) <= step_;
      const double begin = time < 0 ? -range / 2 : 0;
      const bool at_ends = time >= begin && time - begin <= 2 * step_;
      // Fewer samples per turn do not determine the range.
      if (!as_far || !at_ends || range < 16 * step_) continue;
      bits_ = bits;
      return range;
    }
  }
  return std::nullopt;
}

std::string wraps_text(std::string_view column, const Unwrapper& clock) {
  return fmt::format("{}: a counter of {} bits wrapped {}; its times continue", column,
                     clock.bits(),
                     clock.wraps() == 1 ? "once" : fmt::format("{} times", clock.wraps()));
}

namespace {

constexpr std::int64_t one_day = 86400LL * 1'000'000'000;  // [ns]

// Returns the name without a counter: "Time" of "Time (2)", "Time.1" and "Time_3".
std::string_view without_count(std::string_view name) {
  std::string_view stem = name;
  if (stem.ends_with(')')) stem.remove_suffix(1);
  const std::size_t digits = stem.find_last_not_of("0123456789") + 1;
  if (digits == 0 || digits == stem.size()) return name;
  stem = stem.substr(0, digits);
  while (stem.size() > 1 && std::string_view(" ._(").find(stem.back()) != std::string_view::npos)
    stem.remove_suffix(1);
  return stem;
}

}  // namespace

bool holds_time(ColumnKind kind) {
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

// Finds the order of day and month: one date with a first or second number above 12 decides for
// all.
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
      if (stamp->order != DateOrder::unknown) return;  // and so do all other dates
      if (stamp->first > 12) order_ = DateOrder::day_first;
      if (stamp->second > 12) order_ = DateOrder::month_first;
      if (order_ != DateOrder::unknown) return;
      if (!doubtful.empty() || stamp->first == stamp->second) continue;
      doubtful = text;
      line = row.line;
    }
  }
  order_ = DateOrder::day_first;  // day and month are equal in all dates
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
    if (first_ && stamp->has_zone) zone_ = stamp->offset;
  }
  // A time of day without a date restarts at midnight.
  if (!dated && !first_ && instant + days_ < last_ - one_day / 2) days_ += one_day;
  instant += days_;
  last_ = instant;
  if (first_) dated_ = dated;
  first_ = false;
  return instant - offset;
}

std::optional<std::int64_t> SplitSeconds::read(const Row& row, NumberStyle style,
                                               std::size_t& cell) const {
  cell = seconds;
  const auto whole = number_in(row.cells[seconds].text, style);
  if (!whole || !std::isfinite(*whole)) return std::nullopt;
  cell = rest;
  const auto part = number_in(row.cells[rest].text, style);
  if (!part || !std::isfinite(*part)) return std::nullopt;
  return std::llround(*whole) * 1'000'000'000 + std::llround(*part * unit * 1e9);
}

namespace {

// Endings of the names of the two columns.
struct SplitName {
  std::string_view seconds, rest;
  double unit;
};
constexpr SplitName split_names[] = {
    {"sec", "nanosec", 1e-9},         {"secs", "nsecs", 1e-9},    {"sec", "nsec", 1e-9},
    {"sec", "nanoseconds", 1e-9},     {"secs", "nanosecs", 1e-9}, {"sec", "usec", 1e-6},
    {"seconds", "nanoseconds", 1e-9}, {"secs", "usecs", 1e-6},    {"sec", "microsec", 1e-6},
    {"seconds", "microseconds", 1e-6}};

bool is_split(const Grid& grid, const SplitSeconds& pair) {
  Body body(grid);
  for (Row row; body.next(row);) {
    std::size_t cell = 0;
    if (!pair.read(row, grid.dialect.numbers, cell)) continue;
    const double whole = *number_in(row.cells[pair.seconds].text, grid.dialect.numbers);
    const double rest = *number_in(row.cells[pair.rest].text, grid.dialect.numbers) * pair.unit;
    if (whole != std::floor(whole) || rest < 0 || rest >= 1) return false;
  }
  return body.count() > 0;
}

}  // namespace

std::optional<SplitSeconds> split_seconds(const Grid& grid, std::optional<std::size_t> column) {
  const std::vector<Heading>& all = grid.headings();
  for (std::size_t i = column.value_or(0); i < (column ? *column + 1 : all.size()); ++i) {
    for (const SplitName& known : split_names) {
      std::string_view stem = all[i].name;
      if (!stem.ends_with(known.seconds)) continue;
      stem.remove_suffix(known.seconds.size());
      const auto other = std::ranges::find_if(all, [&](const Heading& h) {
        return h.name.size() == stem.size() + known.rest.size() && h.name.starts_with(stem) &&
               h.name.ends_with(known.rest);
      });
      if (other == all.end()) continue;
      const SplitSeconds pair{i, static_cast<std::size_t>(other - all.begin()), known.unit};
      if (is_split(grid, pair)) return pair;
    }
  }
  return std::nullopt;
}

RowClock::RowClock(const Grid& grid, const Source& source, std::optional<std::size_t> column)
    : style_(grid.dialect.numbers) {
  if (!source.rate.empty() || (column == 0 && grid.dialect.period > 0)) {
    kind_ = Kind::rate;
    period_ = source.rate.empty() ? grid.dialect.period : period_of_rate(source.rate);
    if (source.rate.empty()) columns_ = {0};
    return;
  }
  if (!column) return;
  kind_ = Kind::instants;
  if (holds_time(grid.dialect.kinds[*column])) {
    stamps_.emplace(grid, source, *column);
    columns_ = stamps_->columns();
  } else if ((split_ = split_seconds(grid, column))) {
    columns_ = {split_->seconds, split_->rest};
  } else {
    kind_ = Kind::numbers;
    columns_ = {*column};
  }
}

std::optional<RowTime> RowClock::read(const Row& row, std::size_t index, std::size_t& cell) {
  if (kind_ == Kind::rate) return RowTime{.number = static_cast<double>(index) * period_};
  if (kind_ == Kind::instants) {
    const auto instant = stamps_ ? stamps_->read(row, cell) : split_->read(row, style_, cell);
    return instant ? std::optional(RowTime{.instant = *instant}) : std::nullopt;
  }
  cell = columns_.front();
  const auto number = number_in(row.cells[cell].text, style_);
  if (!number || !std::isfinite(*number)) return std::nullopt;
  return RowTime{.number = unwrap_(*number)};
}

const char* RowClock::expected() const {
  return stamps_ ? "a date or a time of day as in the other rows" : "a number";
}

void RowClock::note_wraps(std::string_view column, std::vector<std::string>& notes) const {
  if (unwrap_.wraps() > 0) notes.push_back(wraps_text(column, unwrap_));
}

std::vector<ClockColumns> clock_columns(const Grid& grid, std::optional<std::size_t> clock) {
  std::vector<ClockColumns> out;
  const std::vector<Heading>& all = grid.headings();
  if (!clock) return out;
  const ColumnKind kind = grid.dialect.kinds[*clock];
  for (std::size_t i = *clock; i < all.size(); ++i) {
    if (without_count(all[i].name) != without_count(all[*clock].name)) continue;
    if (grid.dialect.kinds[i] != kind) continue;
    if (!out.empty()) out.back().to = i;
    out.push_back({i, out.empty() ? 0 : i, all.size()});
  }
  const auto has_numbers = [&](const ClockColumns& c) {
    for (std::size_t i = c.from; i < c.to; ++i)
      if (i != c.clock && grid.dialect.kinds[i] == ColumnKind::numbers) return true;
    return false;
  };
  if (out.size() < 2 || !std::ranges::all_of(out, has_numbers)) out.clear();
  return out;
}

double period_of_rate(const std::string& rate) {
  const std::size_t number = rate.find_first_not_of("0123456789.+-eE");
  std::string text = rate;
  if (number != std::string::npos) {
    const auto unit = units::spellings(std::string_view(rate).substr(number));
    if (!unit.empty() && unit.front().factor == 1)
      text = rate.substr(0, number) + " " + unit.front().unit;
  }
  const units::Parsed frequency = units::parse_quantity(text, "Hz");
  const units::Parsed period = units::parse_quantity(text, "s");
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

namespace {

// Rows that share a time: [from, to).
struct TimeGroup {
  std::size_t from = 0, to = 0;
  double step = 0;  // between its rows  [s]; 0: no later time exists
  double count() const { return static_cast<double>(to - from); }
};

std::vector<TimeGroup> groups_of(const std::vector<double>& time) {
  std::vector<TimeGroup> out;
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (i == 0 || time[i] != time[i - 1]) out.push_back({.from = i});
    out.back().to = i + 1;
  }
  return out;
}

}  // namespace

std::size_t spread_times(std::vector<double>& time) {
  std::vector<TimeGroup> groups = groups_of(time);
  const std::size_t shared = time.size() - groups.size();
  if (shared == 0 || groups.size() < 2) return 0;

  double reach = 0;  // the clock's resolution  [s]
  for (std::size_t g = 1; g < groups.size(); ++g) {
    const double step = time[groups[g].from] - time[groups[g - 1].from];
    if (step > 0 && (reach == 0 || step < reach)) reach = step;
  }
  for (std::size_t g = 0; g + 1 < groups.size(); ++g)
    groups[g].step =
        std::min(time[groups[g + 1].from] - time[groups[g].from], reach) / groups[g].count();

  // The recording may begin and end within one step of the clock.
  TimeGroup &first = groups.front(), &last = groups.back();
  double rows = 0, duration = 0;  // between the first and the last time
  for (std::size_t g = 1; g + 1 < groups.size(); ++g) {
    rows += groups[g].count();
    duration += groups[g].step * groups[g].count();
  }
  const double usual = rows > 0 ? duration / rows : first.step;
  last.step = std::min(usual, reach / last.count());
  // A single first row keeps its time, unless the clock is much coarser than the rows.
  const double each = reach / std::max(usual, 1e-12);  // rows per time
  if (usual < first.step && (first.count() > 1 || each > 3)) {
    const double end = time[first.from] + first.step * first.count();
    first.step = usual;
    time[first.from] = end - first.step * first.count();
  }
  for (const TimeGroup& g : groups)
    for (std::size_t i = g.from + 1; i < g.to; ++i)
      time[i] = time[g.from] + g.step * static_cast<double>(i - g.from);
  return shared;
}

void check_order(const std::vector<double>& time, const std::vector<int>& lines,
                 config::Problems& problems) {
  const auto back = std::is_sorted_until(time.begin(), time.end());
  if (back == time.end()) return;
  const auto row = static_cast<std::size_t>(back - time.begin());
  problems.add(lines[row], 1, "time", fmt::format("{} s after {} s", time[row], time[row - 1]),
               "times that do not run backwards",
               "to sort the rows by their time, or a file for each recorder's own rows");
}

void refuse_repeated(const std::vector<double>& time, const std::vector<int>& lines,
                     config::Problems& problems) {
  std::size_t count = 0, first = 0;
  for (std::size_t i = 1; i < time.size(); ++i) {
    if (time[i] != time[i - 1] || lines[i] == lines[i - 1]) continue;  // a line may give many rows
    if (count++ == 0) first = i;
  }
  if (count == 0) return;
  problems.add(lines[first], 1, "time",
               fmt::format("{} rows with the time of the row above, as the clock is coarse", count),
               "a time of its own for each row",
               time.front() == time.back()
                   ? "rate=\"100 Hz\" with the rate of the rows, in place of this clock"
                   : "spread_times=true to spread such rows evenly up to the next time");
}

}  // namespace sinew::recording
