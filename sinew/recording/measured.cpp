#include "sinew/recording/measured.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <stdexcept>

#include "sinew/config/diagnostics.h"
#include "sinew/config/quantity.h"
#include "sinew/recording/clock.h"
#include "sinew/recording/columns.h"
#include "sinew/recording/grid.h"
#include "sinew/recording/number.h"
#include "sinew/recording/parts.h"
#include "sinew/recording/wrap.h"

namespace sinew::recording {

namespace {

// The column of the wanted times, where the file has one.
std::optional<std::size_t> clock_of(const Grid& grid, const Source& source) {
  const auto said = source.names.find("time");
  const std::string name = said != source.names.end() ? said->second : "time";
  for (std::size_t i = 0; i < grid.headings().size(); ++i)
    if (grid.headings()[i].is_called(name)) return i;
  return std::nullopt;
}

bool wants_time(std::span<const Wanted> wanted) {
  return std::ranges::find(wanted, "time", &Wanted::name) != wanted.end();
}

// Reads the wanted columns of one grid.
class Table {
 public:
  Table(const Grid& grid, const Source& source)
      : grid_(grid), source_(source), problems_(grid.file) {}

  Measured read(std::span<const Wanted> wanted) {
    refuse_clocks(wanted);
    ColumnFinder finder(grid_, source_, problems_);
    found_ = finder.find(wanted);
    where_ = finder.conditions();
    find_clock();
    problems_.finish();

    Measured out{.file = grid_.file, .notes = grid_.notes};
    const std::size_t rows = grid_.rows_about();
    for (const Found& f : found_) {
      out.columns.push_back({std::string(f.wanted->name),
                             std::string(f.wanted->unit),
                             {},
                             f.shown,
                             f.constant.has_value()});
      out.columns.back().values.reserve(rows);
    }
    out.lines.reserve(rows);
    Body body(grid_);
    read_body(body, out);
    body.finish(out.notes);
    report_dropped(body.count(), out);
    problems_.finish();
    check_sizes(out);
    check_time(out);
    problems_.finish();
    return out;
  }

 private:
  // A time is a number, a stamp, or the count of the row where a rate is given.
  void find_clock() {
    const std::size_t none = grid_.headings().size();
    for (const Found& f : found_) {
      if (f.wanted->name != "time") continue;
      if (f.constant) return;
      if (f.index == none)
        period_ = source_.rate.empty() ? grid_.dialect.period : period_of_rate(source_.rate);
      if (f.index == none || f.is_at) return;
      clock_columns_ = {f.index};
      if (tells_time(grid_.dialect.kinds[f.index])) {
        clock_ = std::make_unique<StampClock>(grid_, source_, f.index);
        clock_columns_ = clock_->columns();
      } else if ((split_ = split_seconds(grid_, f.index))) {
        clock_columns_ = {split_->seconds, split_->rest};
      }
      excel_days_ = source_.dates == "excel" && !clock_;
    }
  }

  // A column of another clock would get the times of the first one.
  void refuse_clocks(std::span<const Wanted> wanted) {
    const std::optional<std::size_t> clock = clock_of(grid_, source_);
    const std::vector<ClockColumns> clocks = clocks_with(clock);
    if (clocks.empty() || !wants_time(wanted)) return;
    const auto is_own = [&](std::size_t column) {
      return std::ranges::any_of(clocks, [&](const ClockColumns& c) {
        return c.clock == *clock && column >= c.from && column < c.to;
      });
    };
    const auto is_there = [&](std::string_view name) {
      return std::ranges::any_of(grid_.headings(),
                                 [&](const Heading& h) { return h.is_called(name); });
    };
    for (const Wanted& w : wanted) {
      if (!w.replaces.empty() && is_there(w.replaces)) continue;
      const auto said = source_.names.find(std::string(w.name));
      const std::string name = said == source_.names.end() ? std::string(w.name) : said->second;
      const auto at = std::ranges::find_if(grid_.headings(),
                                           [&](const Heading& h) { return h.is_called(name); });
      const auto column = static_cast<std::size_t>(at - grid_.headings().begin());
      if (at == grid_.headings().end() || w.name == "time" || is_own(column)) continue;
      problems_.add(grid_.header_line(), at->column, std::string(w.name),
                    fmt::format("the column {} of another clock than {}", config::in_quotes(name),
                                config::in_quotes(grid_.headings()[*clock].name)),
                    "columns of one clock",
                    "the table resampled at the times of one clock; sinew import reads several, "
                    "for channels of a robot");
    }
    problems_.finish();
  }

  // The clocks of which this is one; nothing where it is the only one.
  std::vector<ClockColumns> clocks_with(std::optional<std::size_t> clock) const {
    for (std::size_t i = 0; clock && i <= *clock; ++i) {
      std::vector<ClockColumns> out = clock_columns(grid_, i);
      if (std::ranges::find(out, *clock, &ClockColumns::clock) != out.end()) return out;
    }
    return {};
  }

  // Rows of one time that fill each other's empty cells are one row: a logger wrote a line for each
  // of its channels.
  void read_body(Body& body, Measured& out) {
    Row above, row;
    std::size_t index = 0, merged = 0;
    while (body.next(row)) {
      if (fills(above, row)) {
        take_cells(row, above);
        ++merged;
        continue;
      }
      if (!above.cells.empty() && wanted_row(above)) add_rows(above, index, out);
      std::swap(above, row);
      index = body.count() - 1;
    }
    if (!above.cells.empty() && wanted_row(above)) add_rows(above, index, out);
    if (merged > 0) out.notes.push_back(merged_text(merged));
  }

  bool fills(const Row& above, const Row& row) const {
    if (clock_columns_.empty() || above.cells.empty()) return false;
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
      const std::string_view a = above.cells[i].text, b = row.cells[i].text;
      const bool is_clock = std::ranges::find(clock_columns_, i) != clock_columns_.end();
      if (is_clock ? a != b || is_missing(a) : !is_missing(a) && !is_missing(b)) return false;
    }
    return true;
  }

  static void take_cells(Row& from, Row& to) {
    for (std::size_t i = 0; i < to.cells.size(); ++i)
      if (is_missing(to.cells[i].text)) to.cells[i] = from.cells[i];
    for (auto& text : from.mended) to.mended.push_back(std::move(text));
    from.mended.clear();
  }

  static std::string_view first_of(std::string_view& list) {
    const std::size_t comma = std::min(list.find(','), list.size());
    const std::string_view out = config::trimmed(list.substr(0, comma));
    list.remove_prefix(std::min(comma + 1, list.size()));
    return out;
  }

  bool same(std::string_view cell, std::string_view value) const {
    const auto a = number_in(cell, grid_.dialect.numbers), b = number_in(value);
    return a && b ? *a == *b : cell == value;
  }

  // Every condition of `where` holds.
  bool wanted_row(const Row& row) const {
    return std::ranges::all_of(where_, [&](const auto& condition) {
      for (std::string_view rest = condition.second; !rest.empty();)
        if (same(row.cells[condition.first].text, first_of(rest))) return true;
      return false;
    });
  }

  // One row of the file gives one, or one per column with an @ that is not empty.
  void add_rows(const Row& row, std::size_t index, Measured& out) {
    const bool several = std::ranges::any_of(found_, &Found::is_at);
    if (!several) return add_row(row, index, nullptr, out);
    for (std::size_t i = 0; i < grid_.headings().size(); ++i)
      if (!grid_.headings()[i].at_name.empty() && !row.cells[i].text.empty())
        add_row(row, index, &grid_.headings()[i], out);
  }

  void add_row(const Row& row, std::size_t index, const Heading* at, Measured& out) {
    values_.clear();
    bool missing = false;
    for (const Found& f : found_) {
      const auto value = f.is_at ? condition(*at, f) : value_of(row, index, at, f, missing);
      if (!value && !missing) return;
      if (!value) break;
      values_.push_back(*value);
    }
    if (missing) {
      ++dropped_;
      return;
    }
    for (std::size_t i = 0; i < values_.size(); ++i) out.columns[i].values.push_back(values_[i]);
    out.lines.push_back(row.line);
  }

  std::optional<double> value_of(const Row& row, std::size_t index, const Heading* at,
                                 const Found& f, bool& missing) {
    if (f.constant) return *f.constant;
    if (f.index == grid_.headings().size()) return static_cast<double>(index) * period_;
    if ((clock_ || split_) && f.wanted->name == "time") return stamp(row, f, missing);
    return cell(row, column_of(f, at), f, missing);
  }

  // The column with an @ that is being read stands for all of its name.
  std::size_t column_of(const Found& f, const Heading* at) const {
    if (at && at->name == grid_.headings()[f.index].name)
      return static_cast<std::size_t>(at - grid_.headings().data());
    return f.index;
  }

  std::optional<double> condition(const Heading& at, const Found& f) {
    const config::Parsed parsed =
        config::parse_quantity(at.at_value, f.wanted->unit, source_.atmosphere);
    if (!parsed.mistake) return parsed.si;
    if (bad_conditions_.insert(at.column).second)
      problems_.add(grid_.header_line(), at.column, at.at_name, parsed.mistake->found,
                    parsed.mistake->expected, parsed.mistake->try_this);
    return std::nullopt;
  }

  std::optional<double> stamp(const Row& row, const Found& f, bool& missing) {
    std::size_t column = f.index;
    const auto instant =
        clock_ ? clock_->read(row, column) : split_->read(row, grid_.dialect.numbers, column);
    if (!instant) {
      bad_cell(row, column, f, clock_ ? "a date or a time of day as in the other rows" : "a number",
               missing);
      return std::nullopt;
    }
    if (!first_instant_) first_instant_ = *instant;
    return static_cast<double>(*instant - *first_instant_) / 1e9;
  }

  std::optional<double> cell(const Row& row, std::size_t index, const Found& f, bool& missing) {
    const std::string_view text = row.cells[index].text;
    const auto number = number_in(text, grid_.dialect.numbers);
    if (number && std::isfinite(*number)) {
      if (f.wanted->name != "time") return f.conversion(*number);
      return excel_days_ ? days(*number) : f.conversion(unwrap_(*number));
    }
    for (const auto& [word, meant] : f.wanted->words)
      if (text == word) return meant;
    std::string expected = "a finite number";
    for (const auto& [word, meant] : f.wanted->words)
      expected += fmt::format(" or {}", config::in_quotes(word));
    bad_cell(row, index, f, expected, missing);
    return std::nullopt;
  }

  double days(double number) {
    if (!first_day_) first_day_ = number;
    return (number - *first_day_) * 86400;
  }

  void bad_cell(const Row& row, std::size_t index, const Found& f, const std::string& expected,
                bool& missing) {
    const std::string_view text = row.cells[index].text;
    const bool is_word = hint_for(text, grid_.dialect.numbers).empty() && f.wanted->words.empty();
    const bool is_none = is_missing(text) || number_in(text) ||  // nan, inf
                         (is_word && source_.drop_incomplete);
    if (is_none && source_.drop_incomplete) {
      ++missing_[f.wanted->name];
      missing = true;
      return;
    }
    problems_.add(row.line, row.cells[index].column, std::string(f.wanted->name),
                  text.empty() ? "an empty cell" : config::in_quotes(text), expected,
                  is_none ? "drop_incomplete=true to leave such rows out"
                          : hint_for(text, grid_.dialect.numbers));
  }

  void report_dropped(std::size_t rows, Measured& out) const {
    if (dropped_ == 0) return;
    std::string columns;
    for (const auto& [name, count] : missing_)
      columns += fmt::format("{}{} in {}", columns.empty() ? "" : ", ", count, name);
    out.notes.push_back(fmt::format("{} of {} rows left out: cells that are no numbers ({})",
                                    dropped_, rows, columns));
  }

  // Tells sizes in the file's own unit, as whoever wrote it knows these numbers.
  void check_sizes(const Measured& data) {
    for (std::size_t i = 0; i < found_.size(); ++i) {
      const Found& f = found_[i];
      const Wanted& w = *f.wanted;
      if (w.most <= 0 || data.rows() == 0) continue;
      double size = 0;
      for (const double v : data.columns[i].values) size = std::max(size, std::abs(v));
      if (size >= w.least && size <= w.most) continue;
      const bool in_file = !f.unit.empty() && !f.is_at;
      const auto shown = [&](double si) {
        const std::string_view unit = in_file ? std::string_view(f.unit) : w.unit;
        return fmt::format("{:.4g}{}{}", in_file ? f.conversion.back(si) : si,
                           unit == "1" ? "" : " ", unit == "1" ? "" : unit);
      };
      const bool bare = f.unit.empty() && w.unit == "1" && !f.constant;
      const std::string others = in_file || bare ? possible_units(w, f.conversion.back(size)) : "";
      const bool there = f.index < grid_.headings().size();
      const Heading heading = there ? grid_.headings()[f.index] : Heading{};
      problems_.add(grid_.header_line(), heading.column, std::string(w.name),
                    "values up to " + shown(size),
                    fmt::format("between {} and {}: a wrong unit, or another column",
                                shown(w.least), shown(w.most)),
                    others.empty() ? "" : fmt::format("units.{}={}", heading.name, others));
    }
  }

  // Rows of recorders that were joined block by block stand a little out of order, and a coarse
  // clock gives several rows one time: both are put right and told. A jump back over much of the
  // recording is none of it.
  void check_time(Measured& data) {
    const auto is_time = [&] { return std::ranges::find(data.columns, "time", &Column::name); };
    if (is_time() == data.columns.end()) return;
    if (unwrap_.wraps() > 0) data.notes.push_back(wraps_text("time", unwrap_));
    sort_by_time(data, is_time()->values);
    const auto at = is_time();  // sorting has made the columns anew
    check_order(at->values, data.lines, problems_);
    if (source_.spread_times || !lines_share_times(data, at->values)) {
      const std::size_t count = spread_times(at->values);
      if (count > 0)
        data.notes.push_back(
            fmt::format("{} rows shared the time of another: spread evenly", count));
    }
    refuse_repeated(at->values, data.lines, problems_);
  }

  // Sorts all rows by their times where no row is further back than a share of the recording.
  static void sort_by_time(Measured& data, const std::vector<double>& time) {
    constexpr double most = 0.02;
    if (time.empty() || std::ranges::is_sorted(time)) return;
    const auto [first, last] = std::ranges::minmax(time);
    double latest = time[0], back = 0;
    std::size_t late = 0;
    for (const double t : time) {
      back = std::max(back, latest - t);
      late += t < latest ? 1 : 0;
      latest = std::max(latest, t);
    }
    if (back > most * (last - first)) return;
    std::vector<std::size_t> order(time.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return time[i]; });
    auto notes = std::move(data.notes);
    data = data.subset(order);
    data.notes = std::move(notes);
    data.notes.push_back(fmt::format("{} rows stood after later ones: sorted by their time", late));
  }

  // Does a line of the file give several rows, which have its time in common?
  static bool lines_share_times(const Measured& data, const std::vector<double>& time) {
    for (std::size_t i = 1; i < time.size(); ++i)
      if (time[i] == time[i - 1] && data.lines[i] == data.lines[i - 1]) return true;
    return false;
  }

  const Grid& grid_;
  const Source& source_;
  Problems problems_;
  std::vector<Found> found_;
  std::vector<std::pair<std::size_t, std::string>> where_;  // index of a column, its values
  std::unique_ptr<StampClock> clock_;                       // where times are stamps
  std::optional<SplitSeconds> split_;                       // where they are in two columns
  std::vector<std::size_t> clock_columns_;                  // that hold the times
  Unwrapper unwrap_;
  std::optional<std::int64_t> first_instant_;  // [ns]
  std::optional<double> first_day_;
  bool excel_days_ = false;
  double period_ = 0;             // of rows that have a rate  [s]
  std::vector<double> values_;    // of the row that is read
  std::set<int> bad_conditions_;  // columns that were told
  std::map<std::string_view, std::size_t> missing_;
  std::size_t dropped_ = 0;
};

Measured read_rows(std::string bytes, const Source& source, std::span<const Wanted> wanted) {
  Grid grid = read_grid(std::move(bytes), source);
  const auto clock = wants_time(wanted) ? clock_of(grid, source) : std::nullopt;
  if (source.part != 0) keep_part(grid, source, clock);
  try {
    return Table(grid, source).read(wanted);
  } catch (const config::Error&) {  // several recordings are the better reason, where it is that
    if (source.where.empty()) refuse_parts(grid, source, clock);
    throw;
  }
}

}  // namespace

bool Measured::has(std::string_view name) const {
  return std::ranges::find(columns, name, &Column::name) != columns.end();
}

const std::vector<double>& Measured::operator[](std::string_view name) const {
  for (const Column& column : columns)
    if (column.name == name) return column.values;
  throw std::out_of_range(fmt::format("no column {} was read", name));
}

Measured Measured::subset(std::span<const std::size_t> keep) const {
  Measured out{.file = file, .notes = notes};
  for (const Column& column : columns)
    out.columns.push_back({column.name, column.unit, {}, column.shown, column.is_stated});
  for (const std::size_t row : keep) {
    out.lines.push_back(lines.at(row));
    for (std::size_t i = 0; i < columns.size(); ++i)
      out.columns[i].values.push_back(columns[i].values.at(row));
  }
  return out;
}

Measured parse_measured(std::string_view text, const Source& source,
                        std::span<const Wanted> wanted) {
  return read_rows(std::string(text), source, wanted);
}

Measured read_measured(const Source& source, std::span<const Wanted> wanted) {
  return read_rows(text_of(source, "measurements as CSV"), source, wanted);
}

}  // namespace sinew::recording
