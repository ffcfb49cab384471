#include "sinew/recording/measured.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <stdexcept>

#include "sinew/config/diagnostics.h"
#include "sinew/recording/clock.h"
#include "sinew/recording/columns.h"
#include "sinew/recording/grid.h"
#include "sinew/recording/parts.h"
#include "sinew/recording/recorded.h"
#include "sinew/recording/selected_rows.h"
#include "sinew/units/quantity.h"
#include "sinew/units/unit.h"

namespace sinew::recording {

namespace {

// --- places of the wanted columns in a table, and conversion of their numbers ---

// Specified column that was found in the file.
struct FoundColumn {
  const ColumnSpec* spec = nullptr;
  std::size_t index = 0;  // index of the file's column; the first if there are several
  bool is_at = false;     // whether it is the condition of the columns with an @
  Conversion conversion;
  std::optional<double> constant;  // value for the whole file, SI
  std::string unit;                // unit as written in the file
  std::string shown;               // unit in Sinew's spelling; empty: Sinew has no such unit
};

// Finds the wanted columns of a grid. Columns that are not found are added to `problems`.
class WantedColumns {
 public:
  // Keeps references to all four, which must outlive this object.
  WantedColumns(const Grid& grid, const Source& source, ColumnResolver& columns,
                config::Problems& problems)
      : grid_(grid), source_(source), columns_(columns), problems_(problems) {}

  // Returns the columns found; an optional column that is missing is left out.
  std::vector<FoundColumn> find(std::span<const ColumnSpec> specs);

 private:
  bool find_stated(const ColumnSpec& w, std::vector<FoundColumn>& out);
  void add_offset(const ColumnSpec& w, FoundColumn& f);
  void refuse_ignored_column(const ColumnSpec& w, const std::vector<FoundColumn>& found);
  void refuse_both(const ColumnSpec& w, const std::string& found);
  void find_one(const ColumnSpec& w, std::vector<FoundColumn>& out);
  void check_names(std::span<const ColumnSpec> specs);
  void convert(const ColumnSpec& w, FoundColumn& f);

  const Grid& grid_;
  const Source& source_;
  ColumnResolver& columns_;
  config::Problems& problems_;
};

std::vector<FoundColumn> WantedColumns::find(std::span<const ColumnSpec> specs) {
  std::vector<FoundColumn> out;
  const auto is_found = [&](std::string_view name) {
    return std::ranges::any_of(out, [&](const FoundColumn& f) { return f.spec->name == name; });
  };
  for (const ColumnSpec& w : specs) {
    if (w.replaces.empty() || !is_found(w.replaces))
      find_one(w, out);
    else
      refuse_ignored_column(w, out);
  }
  check_names(specs);
  return out;
}

void WantedColumns::refuse_both(const ColumnSpec& w, const std::string& found) {
  problems_.add(grid_.header().line, 1, std::string(w.name), found, "one of the two");
}

// Refuses a column that would be ignored because a value is stated for the column it replaces.
void WantedColumns::refuse_ignored_column(const ColumnSpec& w,
                                          const std::vector<FoundColumn>& found) {
  const auto at =
      std::ranges::find_if(found, [&](const FoundColumn& f) { return f.spec->name == w.replaces; });
  if (at->index == grid_.headings().size() && grid_.header().called(w.name))
    refuse_both(w, fmt::format("a column, and a value of {} for the whole file", w.replaces));
}

void WantedColumns::find_one(const ColumnSpec& w, std::vector<FoundColumn>& out) {
  const std::vector<Heading>& headings = grid_.headings();
  const bool given = source_.names.contains(std::string(w.name));
  const std::string name = columns_.name_of(w.name);
  const bool header_rate = grid_.dialect.period > 0 && (!given || name == headings[0].name);
  if (find_stated(w, out)) return;
  if (w.name == "time" && (!source_.rate.empty() || header_rate)) {
    out.push_back({.spec = &w, .index = headings.size()});  // no column has its values
    return;
  }
  if (const auto column = columns_.find(w.name)) {
    FoundColumn f{.spec = &w, .index = *column};
    convert(w, f);
    add_offset(w, f);
    columns_.refuse_repeated(*column);
    out.push_back(std::move(f));
    return;
  }
  const auto at = std::ranges::find(headings, name, &Heading::at_name);
  if (at != headings.end()) {
    FoundColumn f{&w, static_cast<std::size_t>(at - headings.begin()), true};
    add_offset(w, f);
    out.push_back(std::move(f));
  } else if (!w.optional || given) {
    columns_.refuse_missing({std::string(w.name), std::string(w.unit), std::string(w.doc)});
  }
}

// Finds a value that is stated for the whole file; returns false if it is missing.
bool WantedColumns::find_stated(const ColumnSpec& w, std::vector<FoundColumn>& out) {
  const std::string setting = fmt::format("values.{}", w.name);
  // The value with the longest matching part of the file's name is used.
  std::optional<std::string> text;
  std::size_t longest = 0;
  for (const std::string& value : source_.values) {
    const Stated stated = stated_in(value);
    if (stated.name != w.name || !stated.is_for(source_.path)) continue;
    const std::size_t length = stated.part.size();
    if (text && length == longest && *text != stated.value)
      problems_.add(0, 0, setting,
                    fmt::format("{} and {} for one file", config::in_quotes(*text),
                                config::in_quotes(stated.value)),
                    "one value", "a longer part of the file's name before the colon");
    if (!text || length > longest) text = stated.value, longest = length;
  }
  if (!text) return false;
  if (source_.names.contains(std::string(w.name)) || grid_.header().called(w.name))
    refuse_both(
        w, fmt::format("a column, and the value {} for the whole file", config::in_quotes(*text)));
  FoundColumn f{.spec = &w, .index = grid_.headings().size()};
  for (const auto& [word, meant] : w.words)
    if (*text == word) f.constant = meant;
  if (w.words.empty()) {
    const units::Parsed parsed = units::parse_quantity(*text, w.unit, source_.atmosphere);
    if (parsed.mistake)
      problems_.add(0, 0, setting, parsed.mistake->found, parsed.mistake->expected,
                    parsed.mistake->try_this);
    f.constant = parsed.si;
  } else if (!f.constant) {
    problems_.add(0, 0, setting, config::in_quotes(*text), std::string(w.doc));
  }
  out.push_back(std::move(f));
  return true;
}

void WantedColumns::add_offset(const ColumnSpec& w, FoundColumn& f) {
  const auto given = source_.offsets.find(std::string(w.name));
  if (given == source_.offsets.end()) return;
  const units::Parsed added = parse_offset(given->second, w.unit, source_.atmosphere);
  if (added.mistake)
    problems_.add(0, 0, fmt::format("offsets.{}", w.name), added.mistake->found,
                  added.mistake->expected, added.mistake->try_this);
  f.conversion.offset += added.si;
}

// Requires that the names in `names`, `units` and the like exist.
void WantedColumns::check_names(std::span<const ColumnSpec> specs) {
  const auto known = config::names_of(specs);
  const auto check = [&](const char* setting, const std::string& name) {
    if (std::ranges::find(known, name) == known.end())
      problems_.add(0, 0, setting, config::in_quotes(name), config::either(known),
                    config::closest_in_quotes(name, known));
  };
  for (const auto& [name, file_name] : source_.names) check("names", name);
  for (const auto& [name, offset] : source_.offsets) check("offsets", name);
  for (const std::string& value : source_.values) check("values", stated_in(value).name);
  check_columns(grid_.header(), "units", source_.units, problems_);
}

void WantedColumns::convert(const ColumnSpec& w, FoundColumn& f) {
  const bool stamps = holds_time(grid_.dialect.kinds[f.index]) || source_.dates == "excel" ||
                      (w.name == "time" && split_seconds(grid_, f.index));
  if (!w.words.empty() || (w.name == "time" && stamps)) return;
  f.unit = columns_.unit_of(f.index);
  const auto unit =
      columns_.convert(f.index, {std::string(w.name), std::string(w.unit), std::string(w.doc)});
  if (!unit) return;
  f.conversion = unit->conversion;
  f.shown = unit->shown;
}

// Returns units of the wanted dimension with which the file's number would be in range: "mm or in".
std::string possible_units(const ColumnSpec& spec, double number, const std::string& column) {
  const auto [unit, reference] = units::unit_and_reference(spec.unit);
  std::string out;
  const units::Dimension dimension = units::read_unit(unit).unit.dimension;
  for (const units::Unit& u : units::known_units) {
    const double size = std::abs(number) * u.numerator / u.denominator;
    if (!(u.dimension == dimension) || size < spec.least || size > spec.most) continue;
    const std::string setting = stated_setting(
        "units", column, fmt::format("{}{}{}", u.name, reference.empty() ? "" : " ", reference));
    // Only the first has the whole setting; of the others what is in quotes is enough.
    out += out.empty() ? setting : " or " + setting.substr(setting.find('"'));
  }
  return out;
}

bool needs_time(std::span<const ColumnSpec> specs) {
  return std::ranges::find(specs, "time", &ColumnSpec::name) != specs.end();
}

// Reads the wanted columns of a grid.
class Table {
 public:
  Table(const Grid& grid, const Source& source)
      : grid_(grid),
        source_(source),
        problems_(grid.file),
        columns_(grid.header(), source.names, source.units, source.atmosphere, problems_) {}

  Measured read(std::span<const ColumnSpec> specs) {
    refuse_clocks(specs);
    found_ = WantedColumns(grid_, source_, columns_, problems_).find(specs);
    find_clock();
    SelectedRows rows(grid_, source_, clock_, read_columns(), problems_);
    problems_.finish();

    Measured out{.file = grid_.file, .notes = grid_.notes};
    const std::size_t count = grid_.rows_about();
    for (const FoundColumn& f : found_) {
      out.columns.push_back({std::string(f.spec->name),
                             std::string(f.spec->unit),
                             {},
                             f.shown,
                             f.constant.has_value()});
      out.columns.back().values.reserve(count);
    }
    out.lines.reserve(count);
    while (rows.next()) add_rows(rows, out);
    report_dropped(rows.finish(out.notes), out);
    problems_.finish();
    check_sizes(out);
    check_time(out);
    problems_.finish();
    return out;
  }

 private:
  // Finds the source of the times: a column, the header or a rate.
  void find_clock() {
    const auto time =
        std::ranges::find(found_, "time", [](const FoundColumn& f) { return f.spec->name; });
    if (time == found_.end() || time->constant || time->is_at) return;
    const bool of_header = time->index == grid_.headings().size();
    clock_ = RowClock(grid_, source_, of_header ? 0 : time->index);
  }

  std::vector<std::size_t> read_columns() const {
    std::vector<std::size_t> out;
    for (const FoundColumn& f : found_)
      if (!f.is_at && f.index < grid_.headings().size()) out.push_back(f.index);
    for (std::size_t i = 0; i < grid_.headings().size(); ++i)
      if (!grid_.headings()[i].at_name.empty()) out.push_back(i);
    std::erase_if(out, [&](std::size_t i) { return std::ranges::count(clock_.columns(), i) > 0; });
    return out;
  }

  // Refuses columns of another clock, as they would get the times of the first one.
  void refuse_clocks(std::span<const ColumnSpec> specs) {
    const std::optional<std::size_t> clock = columns_.find("time");
    const std::vector<ClockColumns> clocks = clocks_with(clock);
    if (clocks.empty() || !needs_time(specs)) return;
    const auto is_own = [&](std::size_t column) {
      return std::ranges::any_of(clocks, [&](const ClockColumns& c) {
        return c.clock == *clock && column >= c.from && column < c.to;
      });
    };
    for (const ColumnSpec& w : specs) {
      if (!w.replaces.empty() && grid_.header().called(w.replaces)) continue;
      const auto column = columns_.find(w.name);
      if (!column || w.name == "time" || is_own(*column)) continue;
      const Heading& heading = grid_.headings()[*column];
      problems_.add(
          grid_.header().line, heading.column, std::string(w.name),
          fmt::format("the column {} of another clock than {}", config::in_quotes(heading.name),
                      config::in_quotes(grid_.headings()[*clock].name)),
          "columns of one clock",
          "the table resampled at the times of one clock; sinew import reads several, "
          "for channels of a robot");
    }
    problems_.finish();
  }

  // Returns the clocks of the table if the given one is among them; nothing if it is the only one.
  std::vector<ClockColumns> clocks_with(std::optional<std::size_t> clock) const {
    for (std::size_t i = 0; clock && i <= *clock; ++i) {
      std::vector<ClockColumns> out = clock_columns(grid_, i);
      if (std::ranges::find(out, *clock, &ClockColumns::clock) != out.end()) return out;
    }
    return {};
  }

  // Adds one row, or one for each column with an @ whose cell is not empty.
  void add_rows(SelectedRows& rows, Measured& out) {
    if (std::ranges::none_of(found_, &FoundColumn::is_at)) return add_row(rows, nullptr, out);
    for (std::size_t i = 0; i < grid_.headings().size(); ++i)
      if (!grid_.headings()[i].at_name.empty() && !rows.row().cells[i].text.empty())
        add_row(rows, &grid_.headings()[i], out);
  }

  void add_row(SelectedRows& rows, const Heading* at, Measured& out) {
    values_.clear();
    for (const FoundColumn& f : found_) {
      const auto value = f.is_at ? condition(*at, f) : value_of(rows, at, f);
      if (!value) return;
      if (std::isnan(*value)) {
        ++missing_[f.spec->name];
        ++dropped_;
        return;
      }
      values_.push_back(*value);
    }
    for (std::size_t i = 0; i < values_.size(); ++i) out.columns[i].values.push_back(values_[i]);
    out.lines.push_back(rows.row().line);
  }

  // Returns the value in SI: NaN if it is missing; nothing after a fault.
  std::optional<double> value_of(SelectedRows& rows, const Heading* at, const FoundColumn& f) {
    if (f.constant) return *f.constant;
    if (f.spec->name == "time") {
      const std::optional<RowTime> time = rows.time();
      return time ? std::optional(seconds(*time, f)) : std::nullopt;
    }
    const auto number = rows.number(column_of(f, at), f.spec->name, false, f.spec->words);
    return number ? std::optional(f.conversion(*number)) : std::nullopt;
  }

  double seconds(const RowTime& time, const FoundColumn& f) {
    if (std::isnan(time.number) || clock_.kind() == RowClock::Kind::rate) return time.number;
    if (clock_.kind() == RowClock::Kind::numbers && source_.dates != "excel")
      return f.conversion(time.number);
    if (!first_time_) first_time_ = time;
    return clock_.kind() == RowClock::Kind::instants
               ? static_cast<double>(time.instant - first_time_->instant) / 1e9
               : (time.number - first_time_->number) * 86400;
  }

  // Returns the column to read: `at` represents all columns of its name.
  std::size_t column_of(const FoundColumn& f, const Heading* at) const {
    if (at && at->name == grid_.headings()[f.index].name)
      return static_cast<std::size_t>(at - grid_.headings().data());
    return f.index;
  }

  std::optional<double> condition(const Heading& at, const FoundColumn& f) {
    const units::Parsed parsed =
        units::parse_quantity(at.at_value, f.spec->unit, source_.atmosphere);
    if (!parsed.mistake) return parsed.si;
    if (bad_conditions_.insert(at.column).second)
      problems_.add(grid_.header().line, at.column, at.at_name, parsed.mistake->found,
                    parsed.mistake->expected, parsed.mistake->try_this);
    return std::nullopt;
  }

  void report_dropped(std::size_t rows, Measured& out) const {
    if (dropped_ == 0) return;
    std::string columns;
    for (const auto& [name, count] : missing_)
      columns += fmt::format("{}{} in {}", columns.empty() ? "" : ", ", count, name);
    out.notes.push_back(fmt::format("{} of {} rows left out: cells that are not numbers ({})",
                                    dropped_, rows, columns));
  }

  // Checks sizes; reports them in the file's own unit, which its author is familiar with.
  void check_sizes(const Measured& data) {
    for (std::size_t i = 0; i < found_.size(); ++i) {
      const FoundColumn& f = found_[i];
      const ColumnSpec& w = *f.spec;
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
      const bool there = f.index < grid_.headings().size();
      const Heading heading = there ? grid_.headings()[f.index] : Heading{};
      const std::string others =
          in_file || bare ? possible_units(w, f.conversion.back(size), heading.name) : "";
      problems_.add(grid_.header().line, heading.column, std::string(w.name),
                    "values up to " + shown(size),
                    fmt::format("between {} and {}: a wrong unit, or another column",
                                shown(w.least), shown(w.most)),
                    others);
    }
  }

  // Sorts rows that are slightly out of order, as in blocks of several recorders, and spreads
  // rows that share a time of a coarse clock; both are noted. A jump back over much of the
  // recording is a fault.
  void check_time(Measured& data) {
    const auto is_time = [&] { return std::ranges::find(data.columns, "time", &Column::name); };
    if (is_time() == data.columns.end()) return;
    clock_.note_wraps("time", data.notes);
    sort_by_time(data, is_time()->values);
    const auto at = is_time();  // sorting has replaced the columns
    check_order(at->values, data.lines, problems_);
    if (source_.spread_times || !lines_share_times(data, at->values)) {
      const std::size_t count = spread_times(at->values);
      if (count > 0)
        data.notes.push_back(
            fmt::format("{} rows shared the time of another: spread evenly", count));
    }
    refuse_repeated(at->values, data.lines, problems_);
  }

  // Sorts all rows by their times if none is further back than a small share of the recording.
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

  // Returns whether one line of the file gives several rows, which then share its time.
  static bool lines_share_times(const Measured& data, const std::vector<double>& time) {
    for (std::size_t i = 1; i < time.size(); ++i)
      if (time[i] == time[i - 1] && data.lines[i] == data.lines[i - 1]) return true;
    return false;
  }

  const Grid& grid_;
  const Source& source_;
  config::Problems problems_;
  ColumnResolver columns_;
  std::vector<FoundColumn> found_;
  RowClock clock_;
  std::optional<RowTime> first_time_;
  std::vector<double> values_;    // values of the current row
  std::set<int> bad_conditions_;  // columns already reported
  std::map<std::string_view, std::size_t> missing_;
  std::size_t dropped_ = 0;
};

Measured read_rows(std::string bytes, const Source& source, std::span<const ColumnSpec> specs) {
  Grid grid = read_grid(std::move(bytes), source);
  const auto clock =
      needs_time(specs) ? column_of(grid.header(), source.names, "time") : std::nullopt;
  if (source.part != 0) keep_part(grid, source, clock);
  try {
    return Table(grid, source).read(specs);
  } catch (const config::Error&) {  // several recordings in the file explain the fault better
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
    if (!weights.empty()) {
      out.weights.push_back(weights.at(row));
      out.variances.push_back(variances.at(row));
    }
    for (std::size_t i = 0; i < columns.size(); ++i)
      out.columns[i].values.push_back(columns[i].values.at(row));
  }
  return out;
}

Measured parse_measured(std::string_view text, const Source& source,
                        std::span<const ColumnSpec> specs) {
  return read_rows(std::string(text), source, specs);
}

Measured read_measured(const Source& source, std::span<const ColumnSpec> specs) {
  return read_rows(text_of(source, "measurements as CSV"), source, specs);
}

}  // namespace sinew::recording
