#include "sinew/recording/measured.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <stdexcept>

#include "sinew/config/diagnostics.h"
#include "sinew/config/quantity.h"
#include "sinew/config/text_file.h"
#include "sinew/recording/grid.h"
#include "sinew/units/unit.h"

namespace sinew::recording {

namespace {

constexpr std::size_t most_problems = 8;  // that are told

// Numbers of a file's unit to SI: a pressure may have an offset.
struct Conversion {
  double slope = 1, offset = 0;
  double operator()(double number) const { return offset + slope * number; }
};

// What a quantity is told to try, for a unit alone: "0 kPa gauge" -> "kPa gauge".
std::string without_number(std::string text) {
  for (std::size_t at = 0; (at = text.find("\"0 ", at)) != text.npos;) text.erase(at + 1, 2);
  return text;
}

// Where a wanted column stands in the file.
struct Found {
  const Wanted* wanted = nullptr;
  std::size_t index = 0;  // of the file's column; of the first one where there are several
  bool is_at = false;     // it is the condition of the columns with an @
  Conversion conversion;
};

class Table {
 public:
  Table(const Grid& grid, const Source& source) : grid_(grid), source_(source) {}

  Measured read(std::span<const Wanted> wanted) {
    for (const Wanted& w : wanted) find(w);
    check_names(wanted);
    find_where();
    finish();
    Measured out{.file = grid_.file};
    for (const Found& f : found_)
      out.columns.push_back({std::string(f.wanted->name), std::string(f.wanted->unit), {}});
    for (const Row& row : grid_.rows)
      if (wanted_row(row)) add_rows(row, out);
    report_dropped(out);
    finish();
    check_sizes(out);
    check_time(out);
    finish();
    return out;
  }

 private:
  void add_problem(int line, int column, std::string key, std::string found, std::string expected,
                   std::string try_this = "") {
    ++count_;
    if (problems_.size() < most_problems)
      problems_.push_back({{grid_.file, line, column},
                           std::move(key),
                           std::move(found),
                           std::move(expected),
                           std::move(try_this)});
  }

  void finish() {
    if (problems_.empty()) return;
    if (count_ > problems_.size())
      problems_.back().expected += fmt::format(" (and {} more such)", count_ - problems_.size());
    throw config::Error(problems_);
  }

  std::string name_in_file(std::string_view wanted) const {
    const auto mapped = source_.names.find(std::string(wanted));
    return mapped == source_.names.end() ? std::string(wanted) : mapped->second;
  }

  std::vector<std::string_view> names() const {
    std::vector<std::string_view> out;
    for (const Heading& h : grid_.headings) {
      out.push_back(h.name);
      if (!h.at_name.empty()) out.push_back(h.at_name);
    }
    return out;
  }

  void find(const Wanted& w) {
    const std::string name = name_in_file(w.name);
    Found f{.wanted = &w};
    for (std::size_t i = 0; i < grid_.headings.size(); ++i) {
      const Heading& h = grid_.headings[i];
      const bool at = h.at_name == name;
      if (!at && h.name != name) continue;
      f.index = i;
      f.is_at = at;
      if (!at) f.conversion = conversion(h, w);
      refuse_twice(name, i);
      found_.push_back(f);
      return;
    }
    if (w.optional && !source_.names.contains(std::string(w.name))) return;
    const std::string near = config::closest_in_quotes(name, names());
    add_problem(grid_.header_line, 1, std::string(w.name),
                fmt::format("no column {} among {}", config::in_quotes(name), all_names()),
                fmt::format("`{} [{}]`, {}", w.name, w.unit, w.doc),
                near.empty() ? fmt::format("names.{}=NAME with the file's name for it", w.name)
                             : fmt::format("names.{}={}", w.name, near));
  }

  // Two columns of one name: nobody knows which is meant. Those with an @ belong together.
  void refuse_twice(const std::string& name, std::size_t first) {
    for (std::size_t i = first + 1; i < grid_.headings.size(); ++i) {
      const Heading& h = grid_.headings[i];
      if (h.name == name && h.at_name.empty())
        add_problem(grid_.header_line, h.column, name, "a second column of this name", "one",
                    "another name for it in the header");
    }
  }

  std::string all_names() const {
    std::string out;
    for (const std::string_view name : names()) {
      if (out.find(name) != out.npos) continue;
      if (!out.empty()) out += ", ";
      out += name;
    }
    return out;
  }

  // Every name in `names` and `units` must be somewhere.
  void check_names(std::span<const Wanted> wanted) {
    const auto known = config::names_of(wanted);
    for (const auto& [name, file_name] : source_.names)
      if (std::find(known.begin(), known.end(), name) == known.end())
        add_problem(0, 0, "names", config::in_quotes(name), config::either(known),
                    config::closest_in_quotes(name, known));
    const auto columns = names();
    for (const auto& [column, unit] : source_.units)
      if (std::find(columns.begin(), columns.end(), column) == columns.end())
        add_problem(0, 0, "units", config::in_quotes(column),
                    "a column of the file: " + all_names(),
                    config::closest_in_quotes(column, columns));
  }

  void find_where() {
    for (const auto& [name, values] : source_.where) {
      const auto at = std::ranges::find(grid_.headings, name, &Heading::name);
      if (at == grid_.headings.end()) {
        add_problem(0, 0, "where", config::in_quotes(name), "a column of the file: " + all_names(),
                    config::closest_in_quotes(name, names()));
        continue;
      }
      where_.push_back({static_cast<std::size_t>(at - grid_.headings.begin()), values});
    }
  }

  static bool same(std::string_view cell, std::string_view value) {
    const std::optional<double> a = number_in(cell), b = number_in(value);
    return a && b ? *a == *b : cell == value;
  }

  // Every condition of `where` holds.
  bool wanted_row(const Row& row) const {
    return std::all_of(where_.begin(), where_.end(), [&](const auto& condition) {
      std::string_view rest = condition.second;
      while (!rest.empty()) {
        const std::size_t comma = std::min(rest.find(','), rest.size());
        std::string_view value = rest.substr(0, comma);
        while (value.starts_with(' ')) value.remove_prefix(1);
        if (same(row.cells[condition.first].text, value)) return true;
        rest.remove_prefix(std::min(comma + 1, rest.size()));
      }
      return false;
    });
  }

  Conversion conversion(const Heading& h, const Wanted& w) {
    if (!w.words.empty()) return {};
    const auto override = source_.units.find(h.name);
    const std::string unit = override != source_.units.end() ? override->second : h.unit;
    const auto parse = [&](int number) {
      return config::parse_quantity(fmt::format("{} {}", number, unit), w.unit, source_.atmosphere);
    };
    const config::Parsed zero = parse(0), one = parse(1);
    if (!zero.mistake) return {one.si - zero.si, zero.si};
    if (unit.empty()) {
      add_problem(grid_.header_line, h.column, std::string(w.name),
                  fmt::format("the column {} without a unit", config::in_quotes(h.name)),
                  config::describe_unit(w.unit),
                  fmt::format("`{0} [{1}]` in the header, or units.{0}=\"{1}\"", h.name, w.unit));
    } else {
      add_problem(grid_.header_line, h.column, std::string(w.name),
                  fmt::format("the unit {}", config::in_quotes(unit)),
                  config::describe_unit(w.unit), without_number(zero.mistake->try_this));
    }
    return {};
  }

  // One row of the file gives one, or one per column with an @ that is not empty.
  void add_rows(const Row& row, Measured& out) {
    bool several = false;
    for (const Found& f : found_) several |= f.is_at;
    if (!several) return add_row(row, nullptr, out);
    for (std::size_t i = 0; i < grid_.headings.size(); ++i)
      if (!grid_.headings[i].at_name.empty() && !row.cells[i].text.empty())
        add_row(row, &grid_.headings[i], out);
  }

  void add_row(const Row& row, const Heading* at, Measured& out) {
    std::vector<double> values;
    for (const Found& f : found_) {
      const auto value = f.is_at ? condition(*at, f) : cell(row, column_of(f, at), f);
      if (!value) return;
      values.push_back(*value);
    }
    for (std::size_t i = 0; i < values.size(); ++i) out.columns[i].values.push_back(values[i]);
    out.lines.push_back(row.line);
  }

  // The column with an @ that is being read stands for all of its name.
  std::size_t column_of(const Found& f, const Heading* at) const {
    if (at && at->name == grid_.headings[f.index].name)
      return static_cast<std::size_t>(at - grid_.headings.data());
    return f.index;
  }

  std::optional<double> condition(const Heading& at, const Found& f) {
    const config::Parsed parsed =
        config::parse_quantity(at.at_value, f.wanted->unit, source_.atmosphere);
    if (!parsed.mistake) return parsed.si;
    if (bad_conditions_.insert(at.column).second)
      add_problem(grid_.header_line, at.column, at.at_name, parsed.mistake->found,
                  parsed.mistake->expected, parsed.mistake->try_this);
    return std::nullopt;
  }

  std::optional<double> cell(const Row& row, std::size_t index, const Found& f) {
    std::string_view text = row.cells[index].text;
    if (!text.empty() && text.front() == '+') text.remove_prefix(1);
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool whole = error == std::errc{} && end == text.data() + text.size();
    if (whole && std::isfinite(number)) return f.conversion(number);
    for (const auto& [word, meant] : f.wanted->words)
      if (text == word) return meant;
    bad_cell(row, index, f);
    return std::nullopt;
  }

  void bad_cell(const Row& row, std::size_t index, const Found& f) {
    const std::string_view text = row.cells[index].text;
    const std::size_t comma = text.find(',');
    std::string with_point(text);
    if (comma != text.npos) with_point[comma] = '.';
    const bool decimal_comma = comma != text.npos && is_number(with_point);
    const bool missing = text.empty() || text == "-" || is_number(text);  // nan, inf
    if (missing && source_.drop_incomplete) {
      ++dropped_;
      return;
    }
    std::string expected = "a finite number";
    for (const auto& [word, meant] : f.wanted->words)
      expected += fmt::format(" or {}", config::in_quotes(word));
    add_problem(row.line, row.cells[index].column, std::string(f.wanted->name),
                text.empty() ? "an empty cell" : config::in_quotes(text), expected,
                decimal_comma ? fmt::format("a decimal point: {}", with_point)
                : missing     ? "drop_incomplete=true to leave such rows out"
                              : "");
  }

  void report_dropped(Measured& out) const {
    if (dropped_ > 0)
      out.notes.push_back(fmt::format("{} of {} rows left out: cells that are no numbers", dropped_,
                                      grid_.rows.size()));
  }

  // Units of the dimension in which the numbers would be possible.
  std::string possible_units(const Found& f, double number) const {
    std::string_view unit = f.wanted->unit, reference;
    for (const std::string_view word : {" gauge", " abs", " diff"}) {
      if (!unit.ends_with(word)) continue;
      reference = word;
      unit.remove_suffix(word.size());
    }
    std::string out;
    const units::Dimension dimension = units::read_unit(unit).unit.dimension;
    for (const units::Unit& u : units::known_units) {
      const double size = std::abs(number) * u.numerator / u.denominator;
      if (!(u.dimension == dimension) || size < f.wanted->least || size > f.wanted->most) continue;
      if (!out.empty()) out += " or ";
      out += fmt::format("{}{}", u.name, reference);
    }
    return out;
  }

  void check_sizes(const Measured& data) {
    for (std::size_t i = 0; i < found_.size(); ++i) {
      const Wanted& w = *found_[i].wanted;
      if (w.most <= 0 || data.rows() == 0) continue;
      double size = 0;
      for (const double v : data.columns[i].values) size = std::max(size, std::abs(v));
      if (size >= w.least && size <= w.most) continue;
      const Conversion& c = found_[i].conversion;
      const std::string units =
          found_[i].is_at ? "" : possible_units(found_[i], (size - c.offset) / c.slope);
      const Heading& heading = grid_.headings[found_[i].index];
      add_problem(grid_.header_line, heading.column, std::string(w.name),
                  fmt::format("values up to {}", config::format_quantity(size, w.unit, w.unit, 4)),
                  fmt::format("between {} and {}: a wrong unit, or another column",
                              config::format_quantity(w.least, w.unit, w.unit, 4),
                              config::format_quantity(w.most, w.unit, w.unit, 4)),
                  units.empty() ? "" : fmt::format("units.{}={}", heading.name, units));
    }
  }

  void check_time(const Measured& data) {
    if (!data.has("time")) return;
    const std::vector<double>& time = data["time"];
    const auto back = std::is_sorted_until(time.begin(), time.end());
    if (back == time.end()) return;
    const auto row = static_cast<std::size_t>(back - time.begin());
    add_problem(data.lines[row], 1, "time",
                fmt::format("{} s after {} s", time[row], time[row - 1]),
                "times that do not run backwards", "to cut the file where a new recording begins");
  }

  const Grid& grid_;
  const Source& source_;
  std::vector<Found> found_;
  std::vector<config::Problem> problems_;
  std::vector<std::pair<std::size_t, std::string>> where_;  // index of a column, its values
  std::set<int> bad_conditions_;                            // columns that were told
  std::size_t count_ = 0, dropped_ = 0;
};

}  // namespace

bool Measured::has(std::string_view name) const {
  return std::any_of(columns.begin(), columns.end(),
                     [name](const Column& c) { return c.name == name; });
}

const std::vector<double>& Measured::operator[](std::string_view name) const {
  for (const Column& column : columns)
    if (column.name == name) return column.values;
  throw std::out_of_range(fmt::format("no column {} was read", name));
}

Measured Measured::subset(std::span<const std::size_t> keep) const {
  Measured out{.file = file, .notes = notes};
  for (const Column& column : columns) out.columns.push_back({column.name, column.unit, {}});
  for (const std::size_t row : keep) {
    out.lines.push_back(lines.at(row));
    for (std::size_t i = 0; i < columns.size(); ++i)
      out.columns[i].values.push_back(columns[i].values.at(row));
  }
  return out;
}

Measured parse_measured(std::string_view text, const Source& source,
                        std::span<const Wanted> wanted) {
  const Grid grid = read_grid(text, source.path, source.columns);
  return Table(grid, source).read(wanted);
}

std::string text_of(const Source& source, std::string_view what) {
  return source.text ? *source.text : config::read_text_file(source.path, std::string(what));
}

Measured read_measured(const Source& source, std::span<const Wanted> wanted) {
  return parse_measured(text_of(source, "measurements as CSV"), source, wanted);
}

}  // namespace sinew::recording
