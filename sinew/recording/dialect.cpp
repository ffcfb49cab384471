#include "sinew/recording/dialect.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>

#include "sinew/config/diagnostics.h"
#include "sinew/config/quantity.h"
#include "sinew/recording/sample.h"
#include "sinew/recording/stamp.h"

namespace sinew::recording {

namespace {

bool all_missing(const Row& row) {
  return std::ranges::all_of(row.cells, [](const Cell& c) { return is_missing(c.text); });
}

// "s;bar;mm": units and nothing else, at least one of which is no number.
bool is_units_row(const Row& row) {
  const auto says_something = [](const Cell& c) {
    return !is_missing(c.text) && !number_in(c.text);
  };
  return std::ranges::all_of(row.cells, [](const Cell& c) { return is_unit_cell(c.text); }) &&
         std::ranges::any_of(row.cells, says_something);
}

// The index of the first row of values; the number of rows where there is none.
std::size_t first_of_values(const Sample& sample) {
  const std::vector<Row>& rows = sample.rows;
  if (sample.labview.is_there) return std::min<std::size_t>(1, rows.size());
  std::size_t first_fitting = rows.size();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!sample.fits(rows[i])) continue;
    const bool is_first = first_fitting == rows.size();
    if (is_first) first_fitting = i;
    const Sample::Tally tally = sample.tally(rows[i]);
    if (tally.values == 0) continue;
    // A header's names may be numbers, but not all of them; a row may have a cell that is wrong.
    if (tally.words > 0 && (is_first || is_units_row(rows[i]) || tally.values < tally.words))
      continue;
    while (i > 0 && sample.fits(rows[i - 1]) && all_missing(rows[i - 1])) --i;
    return i;
  }
  return std::min(first_fitting + 1, rows.size());
}

// Names that blanks part from their units: "time [s]  force [N]".
std::vector<Cell> joined_units(std::vector<Cell> cells, std::size_t width,
                               std::deque<std::string>& texts) {
  std::vector<Cell> out;
  for (const Cell& cell : cells) {
    const bool unit = cell.text.starts_with('[') || cell.text.starts_with('(');
    if (!unit || out.empty()) {
      out.push_back(cell);
      continue;
    }
    texts.push_back(fmt::format("{} {}", out.back().text, cell.text));
    out.back().text = texts.back();
  }
  return out.size() == width ? out : cells;
}

// Reads the header of one table.
class HeaderReader {
 public:
  HeaderReader(const Sample& sample, const Source& source) : sample_(sample), source_(source) {}

  void read(Dialect& out) {
    const std::size_t first = first_of_values(sample_);
    std::size_t top = first;
    if (!source_.columns.empty()) {
      for (const std::string& column : source_.columns)
        out.headings.push_back(heading_of({column, 1}));
      begin_body(first < sample_.rows.size() ? first : 0, out);
      top = first < sample_.rows.size() ? first : 0;
    } else {
      top = find_names(first, out);
      begin_body(first, out);
    }
    if (sample_.rows[top].line > sample_.first_line) note_above(top, out);
  }

 private:
  // Returns the index of the first row that is used.
  std::size_t find_names(std::size_t first, Dialect& out) const {
    if (first == 0) {
      use_comment(out);
      return 0;
    }
    std::size_t names = first - 1;
    const Row* units = nullptr;
    const std::vector<Row>& rows = sample_.rows;
    while (names > 0 && sample_.width > 1 && is_date_line(rows[names])) {
      out.notes.push_back(fmt::format("line {}, {}: left out", rows[names].line,
                                      config::in_quotes(rows[names].cells.front().text)));
      --names;
    }
    if (names > 0 && is_units_row(rows[names]) &&
        rows[names - 1].cells.size() >= rows[names].cells.size() &&
        !is_units_row(rows[names - 1])) {
      units = &rows[names];
      --names;
    }
    if (sample_.width > 1 && rows[names].cells.size() == 1) refuse_missing(rows[first]);
    use(rows[names], units, out);
    return names;
  }

  void use(const Row& names, const Row* units, Dialect& out) const {
    out.header_line = names.line;
    std::deque<std::string> texts;
    std::vector<Cell> cells = names.cells;
    if (sample_.separator == ' ' && cells.size() > sample_.width)
      cells = joined_units(cells, sample_.width, texts);
    while (cells.size() > 1 && cells.back().text.empty()) cells.pop_back();
    // LabVIEW names a column of remarks, which most of its rows do not have.
    out.has_remarks = cells.size() > 1 && cells.back().text == "Comment";
    for (const Cell& cell : cells) out.headings.push_back(heading_of(cell));
    use_labview(out);
    if (!units) return;
    for (std::size_t i = 0; i < std::min(cells.size(), units->cells.size()); ++i)
      if (const std::string_view unit = without_brackets(units->cells[i].text); !unit.empty())
        set_unit(out.headings[i], unit);
  }

  // Units and a clock that LabVIEW writes above its rows.
  void use_labview(Dialect& out) const {
    const LabViewHeader& header = sample_.labview;
    for (std::size_t i = 0; i < header.units.size() && i + 1 < out.headings.size(); ++i)
      if (out.headings[i + 1].unit.empty() && !without_brackets(header.units[i]).empty() &&
          is_unit_cell(header.units[i]))
        set_unit(out.headings[i + 1], without_brackets(header.units[i]));
    if (header.has_x || !(header.step > 0)) return;
    out.period = header.step;
    out.first = header.first;
    out.notes.push_back(fmt::format("times by Delta_X of its header: {} s from row to row",
                                    config::format_number(header.step)));
  }

  // "# time [s], force [N]", as NumPy writes a header.
  void use_comment(Dialect& out) const {
    RowReader reader(sample_.comment, sample_.separator, 0, sample_.comment_line);
    Row names;
    const bool is_header = reader.next(names) && names.cells.size() == sample_.width &&
                           std::ranges::all_of(names.cells, [](const Cell& c) {
                             return kind_of(c.text) == ColumnKind::words;
                           });
    if (!is_header) refuse_missing(sample_.rows.front());
    use(names, nullptr, out);
  }

  [[noreturn]] void refuse_missing(const Row& row) const {
    const bool first = &row == &sample_.rows.front();
    config::fail({source_.path, row.line, 1}, "header",
                 first ? "numbers in the first line" : "numbers without names above them",
                 "a header that names the columns with their units: `time [s],force [N]`",
                 "columns=\"name [unit],name [unit]\" with the columns' meaning");
  }

  void begin_body(std::size_t first, Dialect& out) const {
    if (first >= sample_.rows.size()) {
      const int line = sample_.rows.empty() ? 1 : sample_.rows.back().line;
      config::fail({source_.path, line, 1}, "rows", "none", "a header and rows of numbers");
    }
    out.body = sample_.rows[first].at;
    out.body_line = sample_.rows[first].line;
  }

  void note_above(std::size_t top, Dialect& out) const {
    const int from = sample_.first_line, to = sample_.rows[top].line - 1;
    out.notes.push_back(from == to
                            ? fmt::format("line {}, above the table: left out", from)
                            : fmt::format("lines {} to {}, above the table: left out", from, to));
  }

  const Sample& sample_;
  const Source& source_;
};

[[noreturn]] void refuse_either(const Row& row, const Cell& cell, const Source& source) {
  config::fail(
      {source.path, row.line, cell.column}, "",
      fmt::format("{}, and no number that shows what its comma is", config::in_quotes(cell.text)),
      "decimal commas or parted thousands, and to know which",
      "decimal=\",\" if the comma is the decimal mark, thousands=\",\" if it parts thousands");
}

// Commas are decimal marks where they can be nothing else, and more so than points.
char decimal_of(const Sample& sample, const Dialect& dialect, const Source& source) {
  if (!source.decimal.empty()) return source.decimal[0];
  if (sample.labview.decimal != '\0') return sample.labview.decimal;
  if (source.thousands == ".") return ',';
  if (source.thousands == ",") return '.';
  std::size_t points = 0, commas = 0;
  const Row* doubtful_row = nullptr;
  const Cell* doubtful = nullptr;
  for (const Row& row : sample.rows) {
    if (row.at < dialect.body) continue;
    for (std::size_t i = 0; i < std::min(row.cells.size(), sample.width); ++i) {
      if (sample.kinds[i] != ColumnKind::numbers || is_missing(row.cells[i].text)) continue;
      const Marks marks = marks_in(row.cells[i].text);
      commas += marks.comma ? 1 : 0;
      points += marks.point ? 1 : 0;
      if (!marks.either || doubtful) continue;
      doubtful_row = &row;
      doubtful = &row.cells[i];
    }
  }
  if (commas > 0) return commas >= points ? ',' : '.';
  if (doubtful && points == 0) refuse_either(*doubtful_row, *doubtful, source);
  return '.';
}

}  // namespace

bool is_date_line(const Row& row) {
  return stamp_in(row.cells.front().text) &&
         std::all_of(row.cells.begin() + 1, row.cells.end(),
                     [](const Cell& c) { return c.text.empty(); });
}

Dialect dialect_of(std::string_view text, const Source& source) {
  const Sample sample = sample_of(text, source.decimal == "," || source.thousands == ".");
  if (sample.rows.empty())
    config::fail({source.path, 1, 1}, "rows", "none", "a header and rows of numbers");
  Dialect out;
  out.separator = sample.separator;
  HeaderReader(sample, source).read(out);
  out.kinds = sample.kinds;
  out.kinds.resize(out.headings.size(), ColumnKind::words);
  out.numbers.decimal = decimal_of(sample, out, source);
  if (!source.thousands.empty()) out.numbers.thousands = source.thousands[0];
  return out;
}

}  // namespace sinew::recording
