#include "sinew/recording/raw_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "sinew/config/diagnostics.h"
#include "sinew/recording/clock.h"
#include "sinew/recording/grid.h"
#include "sinew/recording/parts.h"
#include "sinew/recording/selected_rows.h"
#include "sinew/recording/stamp.h"
#include "sinew/recording/text.h"
#include "sinew/units/letters.h"

namespace sinew::recording {

namespace {

constexpr double seconds_per_day = 86400;

// Usual names of a time column, in lower case and in the order in which they are tried, and the
// unit that each implies.
struct ClockNames {
  std::string_view unit;
  std::vector<std::string_view> names;
};
const std::vector<ClockNames>& clock_names() {
  static const std::vector<ClockNames> all = {
      {"",
       {"time", "t", "zeit", "timestamp", "time stamp", "elapsed", "elapsed time", "zeitstempel",
        "datetime", "date/time", "date time", "uhrzeit", "date", "datum", "epoch"}},
      {"s", {"x_value", "time_s", "t_s", "zeit_s", "seconds", "sekunden"}},
      {"ms", {"time_ms", "t_ms", "zeit_ms", "millis", "milliseconds", "timestamp_ms"}},
      {"us", {"time_us", "t_us", "micros", "timestamp_us"}}};
  return all;
}

// Reads all columns of a grid, or those of one of its clocks.
class RawReader {
 public:
  RawReader(const Grid& grid, const Source& source, std::optional<ClockColumns> only = {})
      : grid_(grid),
        source_(source),
        only_(only),
        problems_(grid.file),
        columns_(grid.header(), source.names, source.units, source.atmosphere, problems_) {}

  // Returns the time column, if it can be found.
  std::optional<std::size_t> clock() {
    return source_.rate.empty() ? clock_column() : std::nullopt;
  }

  // Reads the table; `names` holds the names of columns read before.
  RawTable read(std::set<std::string>& names) {
    RawTable out{.file = grid_.file, .header_line = grid_.header().line};
    if (!only_ || only_->from == 0) out.notes = grid_.notes;
    check_columns(grid_.header(), "units", source_.units, problems_);
    find_clock(out);
    choose_columns(names, out);
    SelectedRows rows(grid_, source_, clock_, indices_, problems_, only_);
    problems_.finish();
    while (rows.next()) add(rows, out);
    rows.finish(out.notes);
    problems_.finish();
    finish_clock(out);
    problems_.finish();
    note_missing(out);
    return out;
  }

 private:
  const std::vector<ColumnKind>& kinds() const { return grid_.dialect.kinds; }

  // Returns the given column, a column of stamps, or one with a usual name.
  std::optional<std::size_t> clock_column() {
    if (only_) return only_->clock;
    if (source_.names.contains("time")) {
      const auto column = columns_.find("time");
      if (!column) columns_.refuse_missing({"time", "s", "the clock of the rows"});
      return column;
    }
    for (const ColumnKind kind :
         {ColumnKind::stamps, ColumnKind::dates, ColumnKind::times_of_day}) {
      const auto at = std::ranges::find(kinds(), kind);
      if (at != kinds().end()) return static_cast<std::size_t>(at - kinds().begin());
    }
    for (const ClockNames& known : clock_names())
      for (const std::string_view name : known.names)
        for (std::size_t i = 0; i < grid_.headings().size(); ++i)
          if (units::lower(grid_.headings()[i].name) == name) return i;
    if (const auto pair = split_seconds(grid_)) return pair->seconds;
    return std::nullopt;
  }

  void find_clock(RawTable& out) {
    clock_ = RowClock(grid_, source_, clock());
    of_clock_.insert(clock_.columns().begin(), clock_.columns().end());
    if (clock_.kind() == RowClock::Kind::rate) {
      if (source_.rate.empty()) out.first = grid_.dialect.first;
      return;
    }
    for (const std::size_t used : clock_.columns()) {
      out.clock += (out.clock.empty() ? "" : " and ") + grid_.headings()[used].name;
      out.clock_headings.push_back(grid_.headings()[used]);
    }
    if (!is_numbers() || source_.dates == "excel") return;
    find_unit(clock_.columns().front());
    if (!note_.empty()) out.notes.push_back(note_);
  }

  bool is_numbers() const { return clock_.kind() == RowClock::Kind::numbers; }
  const Heading& clock_heading() const { return grid_.headings()[clock_.columns().front()]; }

  // Finds the unit of a clock of numbers.
  void find_unit(std::size_t column) {
    const Heading& h = grid_.headings()[column];
    std::string unit = columns_.unit_of(column);
    const auto of_clock = given_unit(grid_.header(), source_.clock_units, column);
    if (of_clock && !given_unit(grid_.header(), source_.units, column)) unit = *of_clock;
    for (const ClockNames& known : clock_names())
      if (unit.empty() && std::ranges::count(known.names, units::lower(h.name)) > 0)
        unit = known.unit;
    const auto read = file_unit(unit, "s", source_.atmosphere);
    if (const auto* found = std::get_if<FileUnit>(&read)) {
      slope_ = found->conversion.slope;
      return;
    }
    if (unit.empty() && find_unit_since_1970(h)) return;
    problems_.add(grid_.header().line, h.column, h.name,
                  unit.empty() ? "times without a unit" : "the unit " + config::in_quotes(unit),
                  "s, ms, us, min or h",
                  looks_like_days() ? std::string("dates=excel, if these are Excel's days")
                                    : stated_setting("units", h.name, "s") +
                                          ", or rate=\"100 Hz\" in place of this clock");
  }

  double first_number() const {
    Body body(grid_);
    Row row;
    if (!body.next(row)) return 0;
    const std::string_view text = row.cells[clock_.columns().front()].text;
    return number_in(text, grid_.dialect.numbers).value_or(0);
  }

  bool looks_like_days() const {
    const double first = first_number();
    return first > 30000 && first < 60000;  // 1982 to 2064
  }

  // Recognises a clock since 1970 by the size of its numbers.
  bool find_unit_since_1970(const Heading& h) {
    constexpr std::pair<std::string_view, double> steps[] = {
        {"s", 1}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}};
    const double first = first_number();
    for (const auto& [unit, step] : steps) {
      if (first * step < 1e9 || first * step > 5e9) continue;
      slope_ = step;
      note_ = fmt::format("{}: taken for {} since 1970", h.name, unit);
      return true;
    }
    return false;
  }

  void choose_columns(std::set<std::string>& names, RawTable& out) {
    const std::size_t rows = grid_.rows_about();
    out.lines.reserve(rows);
    if (has_clock()) out.time.reserve(rows);
    std::string words;
    for (std::size_t i = 0; i < grid_.headings().size(); ++i) {
      if (of_clock_.contains(i) || !is_read(i)) continue;
      const Heading& h = grid_.headings()[i];
      if (kinds()[i] != ColumnKind::numbers) {
        words += (words.empty() ? "" : ", ") + (h.name.empty() ? std::to_string(i + 1) : h.name);
        continue;
      }
      add_column(i, names, out);
      out.columns.back().values.reserve(rows);
    }
    if (!words.empty()) out.notes.push_back("columns without numbers left out: " + words);
  }

  void add_column(std::size_t index, std::set<std::string>& names, RawTable& out) {
    const Heading& h = grid_.headings()[index];
    RawColumn column{h};
    column.unit = columns_.unit_of(index);
    if (column.name.empty()) column.name = fmt::format("column {}", index + 1);
    for (int again = 2; !names.insert(column.name).second; ++again) {
      column.name = fmt::format("{} ({})", h.name, again);
      if (!names.contains(column.name))
        out.notes.push_back(fmt::format("a second column {}: called {}", config::in_quotes(h.name),
                                        config::in_quotes(column.name)));
    }
    out.columns.push_back(std::move(column));
    indices_.push_back(index);
  }

  bool has_clock() const { return clock_.kind() != RowClock::Kind::none; }
  bool is_read(std::size_t column) const {
    return !only_ || (column >= only_->from && column < only_->to);
  }

  void add(SelectedRows& rows, RawTable& out) {
    if (has_clock()) {
      const std::optional<RowTime> time = rows.time();
      if (!time) return;
      if (std::isnan(time->number)) {
        ++without_time_;
        return;
      }
      if (clock_.kind() == RowClock::Kind::instants)
        instants_.push_back(time->instant);
      else
        out.time.push_back(time->number);
    }
    out.lines.push_back(rows.row().line);
    for (std::size_t i = 0; i < indices_.size(); ++i) {
      RawColumn& column = out.columns[i];
      const double number = rows.number(indices_[i], column.name, true).value_or(no_value);
      column.values.push_back(number);
      column.missing += std::isnan(number) ? 1 : 0;
    }
  }

  void finish_clock(RawTable& out) {
    if (out.lines.empty() || !has_clock()) return;
    if (clock_.stamps()) {
      out.time = since_first(instants_);
      out.instant = instants_.front();
      out.has_date = clock_.stamps()->has_dates();
      out.zone = clock_.stamps()->zone();
    } else if (clock_.split()) {
      out.time = since_first(instants_);
      out.first = static_cast<double>(instants_.front()) / 1e9;
      if (is_since_1970(out.first)) {
        out.instant = instants_.front();
        out.zone = 0;
      }
    } else if (is_numbers()) {
      count_from_first(out);
      clock_.note_wraps(clock_heading().name, out.notes);
    }
    if (source_.spread_times) {
      if (const std::size_t count = spread_times(out.time); count > 0)
        out.notes.push_back(
            fmt::format("{} rows shared the time of another: spread evenly", count));
    }
    begin_at_first(out);
    if (out.instant) out.start = start_text(*out.instant, out.has_date, out.zone);
    check_order(out.time, out.lines, problems_);
    refuse_repeated(out.time, out.lines, problems_);
    note_seconds(out);
  }

  // Shifts the times so that the first row is time 0 again after its time was spread.
  static void begin_at_first(RawTable& out) {
    const double late = out.time.front();
    if (late == 0 || out.time.size() < 2) return;
    out.first += late;
    if (out.instant) *out.instant += std::llround(late * 1e9);
    for (double& t : out.time) t -= late;
  }

  static bool is_since_1970(double seconds) { return seconds > 1e9 && seconds < 5e9; }

  // Converts a clock's numbers to seconds since the first. Times since 1970 also give the start.
  void count_from_first(RawTable& out) {
    const bool days = source_.dates == "excel";
    const double first = out.time.front(), slope = days ? seconds_per_day : slope_;
    constexpr double days_from_1900_to_1970 = 25569;
    const double epoch = days ? (first - days_from_1900_to_1970) * seconds_per_day : first * slope_;
    if (is_since_1970(epoch)) {
      // Doubles resolve such numbers to about a microsecond.
      out.instant = std::llround(epoch * 1e6) * 1'000;
      if (!days) out.zone = 0;
    }
    out.first = first * slope;
    for (double& t : out.time) t = (t - first) * slope;
  }

  // Notes times that are all whole seconds: the unit may be milliseconds.
  void note_seconds(RawTable& out) const {
    if (!is_numbers() || slope_ != 1 || source_.dates == "excel" || out.time.size() < 20) return;
    const bool whole = std::ranges::all_of(out.time, [](double t) { return t == std::floor(t); });
    const double step = out.time.back() / static_cast<double>(out.time.size() - 1);
    if (!whole || step < 2) return;
    const std::string& name = clock_heading().name;
    out.notes.push_back(
        fmt::format("{}: a row every {:.4g} s, {:.3g} h in all; if it counts ms, give {}", name,
                    step, out.time.back() / 3600, stated_setting("units", name, "ms")));
  }

  void note_missing(RawTable& out) const {
    for (const RawColumn& column : out.columns)
      if (column.missing > 0)
        out.notes.push_back(fmt::format("{}: {} of {} values are missing", column.name,
                                        column.missing, out.rows()));
    if (without_time_ > 0)
      out.notes.push_back(fmt::format("{} rows without a time left out", without_time_));
  }

  const Grid& grid_;
  const Source& source_;
  std::optional<ClockColumns> only_;
  config::Problems problems_;
  ColumnResolver columns_;
  RowClock clock_;
  double slope_ = 1;                    // seconds per unit of the clock
  std::string note_;                    // about the clock
  std::set<std::size_t> of_clock_;      // columns of the clock
  std::vector<std::int64_t> instants_;  // [ns]
  std::vector<std::size_t> indices_;    // indices of the columns that are read
  std::size_t without_time_ = 0;
};

RawTable read_clocks(const Grid& grid, const Source& source) {
  std::set<std::string> names;
  const std::vector<ClockColumns> clocks = clock_columns(grid, RawReader(grid, source).clock());
  if (clocks.empty()) return RawReader(grid, source).read(names);
  RawTable out = RawReader(grid, source, clocks.front()).read(names);
  for (std::size_t i = 1; i < clocks.size(); ++i)
    out.further.push_back(RawReader(grid, source, clocks[i]).read(names));
  out.notes.push_back(fmt::format("{} columns {}: each is the clock of the columns to its right",
                                  clocks.size(),
                                  config::in_quotes(grid.headings()[clocks.front().clock].name)));
  return out;
}

}  // namespace

RawTable read_table(const Source& source) {
  Grid grid = read_grid(text_of(source, "measurements as CSV"), source);
  if (source.part != 0) keep_part(grid, source, RawReader(grid, source).clock());
  try {
    return read_clocks(grid, source);
  } catch (const config::Error&) {  // several recordings in the file explain the fault better
    refuse_parts(grid, source, RawReader(grid, source).clock());
    throw;
  }
}

}  // namespace sinew::recording
