#include "sinew/recording/dialect.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <deque>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "sinew/config/diagnostics.h"
#include "sinew/config/utf8.h"
#include "sinew/recording/stamp.h"
#include "sinew/units/letters.h"
#include "sinew/units/quantity.h"

namespace sinew::recording {

namespace {

using units::trimmed;

// --- sample of a table's first rows, with the most plausible separator ---

// Clock and units in the header of a LabVIEW table.
struct LabViewHeader {
  bool present = false, has_x = true;
  double step = 0, first = 0;      // Delta_X and X0  [s]
  char decimal = '\0';             // '\0': not given
  std::vector<std::string> units;  // units of the columns after X_Value
};

struct Sample {
  LabViewHeader labview;
  char separator = ',';
  int first_line = 0;             // first line that is not empty
  std::vector<Row> rows;          // rows from that line on
  std::size_t width = 0;          // cells of most rows, not counting the header and rows above it
  std::vector<ColumnKind> kinds;  // kinds of the columns
  std::string_view comment;       // last one before the first row
  int comment_line = 0;

  // Number of cells in a row that have their column's kind, and of those that do not; columns of
  // words are not counted.
  struct Tally {
    std::size_t values = 0, words = 0;
  };
  Tally tally(const Row& row) const;

  // Returns whether the row has `width` cells, not counting further empty ones at its end.
  bool fits(const Row& row) const;
};

// Enough to find commas, units and clocks, but few enough to be read once per separator.
constexpr std::size_t most_rows = 400, most_bytes = 1 << 20;

// The earlier of two equally plausible separators is used.
constexpr std::array separators{'\t', ';', ',', ' '};

// Separator given in the first line for spreadsheets, and the offset of the table after it.
struct StatedSeparator {
  char separator = '\0';
  std::size_t at = 0;
};
StatedSeparator stated_separator(std::string_view text) {
  const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
  std::string_view line = text.substr(0, end);
  if (line.size() > 2 && line.front() == '"' && line.back() == '"')
    line = line.substr(1, line.size() - 2);
  const bool stated = line.size() == 5 && (line.starts_with("sep=") || line.starts_with("SEP=") ||
                                           line.starts_with("Sep="));
  if (!stated) return {};
  std::size_t next = end;
  if (next < text.size()) next += text.substr(next).starts_with("\r\n") ? 2 : 1;
  return {line[4], next};
}

// Reads a line of LabVIEW's header: a key, then its value or one value for each column.
void take_labview(const Row& line, LabViewHeader& out) {
  out.present = true;
  if (line.cells.size() < 2) return;
  const std::string_view key = line.cells[0].text, value = line.cells[1].text;
  const auto number = number_in(value) ? number_in(value) : number_in(value, {','});
  if (key == "X_Columns") out.has_x = value != "No";
  if (key == "Decimal_Separator" && value.size() == 1) out.decimal = value[0];
  if (key == "Delta_X" && number) out.step = *number;
  if (key == "X0" && number) out.first = *number;
  if (key != "Y_Unit_Label") return;
  for (std::size_t i = 1; i < line.cells.size(); ++i) out.units.emplace_back(line.cells[i].text);
}

Sample read_sample(std::string_view text, char separator, std::size_t begin) {
  Sample out{.separator = separator};
  RowReader reader(text, separator, begin, begin > 0 ? 2 : 1);
  Row row;
  while (out.rows.size() < most_rows && reader.at() < begin + most_bytes && reader.next(row)) {
    if (out.rows.empty() && out.first_line == 0) {
      out.first_line = row.line;
      out.comment = reader.comment();
      out.comment_line = reader.comment_line();
    }
    // LabVIEW's own table begins after the last of these lines.
    if (row.cells.front().text == "***End_of_Header***") {
      for (const Row& line : out.rows) take_labview(line, out.labview);
      out.rows.clear();
      continue;
    }
    out.rows.push_back(std::move(row));
    row = {};
  }
  return out;
}

// Returns the first row of the later half; lines above the header are in the first half.
std::size_t later_half(const Sample& sample) { return sample.rows.size() / 2; }

void find_width(Sample& sample) {
  std::map<std::size_t, std::size_t> counts;
  for (std::size_t i = later_half(sample); i < sample.rows.size(); ++i)
    ++counts[sample.rows[i].cells.size()];
  std::size_t most = 0;
  for (const auto& [width, count] : counts) {
    if (count < most) continue;
    most = count;
    sample.width = width;
  }
}

// Returns the kind of a cell; nothing if its value is missing.
std::optional<ColumnKind> kind_of(std::string_view cell) {
  if (is_missing(cell)) return std::nullopt;
  if (separator_evidence_in(cell).number) return ColumnKind::numbers;
  const std::optional<Stamp> stamp = stamp_in(cell);
  if (!stamp) return ColumnKind::words;
  if (!stamp->has_date) return ColumnKind::times_of_day;
  return stamp->has_time ? ColumnKind::stamps : ColumnKind::dates;
}

ColumnKind kind_of_column(const Sample& sample, std::size_t column) {
  std::map<ColumnKind, std::size_t> counts;
  for (std::size_t i = later_half(sample); i < sample.rows.size(); ++i) {
    const Row& row = sample.rows[i];
    if (row.cells.size() != sample.width) continue;
    if (const auto kind = kind_of(row.cells[column].text)) ++counts[*kind];
  }
  if (counts.empty()) return ColumnKind::numbers;  // only missing values
  // Lines of units and names may be among few rows, so words must outnumber all values.
  std::size_t values = 0, most = 0;
  ColumnKind best = ColumnKind::words;
  for (const auto& [kind, count] : counts) {
    if (kind == ColumnKind::words) continue;
    values += count;
    if (count <= most) continue;
    most = count;
    best = kind;
  }
  return counts[ColumnKind::words] > values ? ColumnKind::words : best;
}

// Returns how plausible a sample's separator is: the share of values among the cells of rows with
// the usual width; a quarter of that for a single column, as any text makes one.
double plausibility_of(const Sample& sample) {
  std::size_t values = 0, others = 0, rows = 0;
  for (std::size_t i = later_half(sample); i < sample.rows.size(); ++i) {
    const Row& row = sample.rows[i];
    if (row.cells.size() != sample.width) continue;
    ++rows;
    for (const Cell& cell : row.cells)
      if (const auto kind = kind_of(cell.text)) ++(*kind == ColumnKind::words ? others : values);
  }
  if (values == 0) return 0;
  const double usual =
      static_cast<double>(rows) / static_cast<double>(sample.rows.size() - later_half(sample));
  const double share = static_cast<double>(values) / static_cast<double>(values + others);
  return usual * share * (sample.width > 1 ? 1 : 0.25);
}

// Returns the most frequent separator in the line; a comma if it has none.
char most_frequent(std::string_view line) {
  char best = ',';
  std::ptrdiff_t most = 0;
  for (const char c : {',', ';', '\t'}) {
    const std::ptrdiff_t count = std::count(line.begin(), line.end(), c);
    if (count <= most) continue;
    most = count;
    best = c;
  }
  return best;
}

Sample::Tally Sample::tally(const Row& row) const {
  Tally out;
  for (std::size_t i = 0; i < std::min(width, row.cells.size()); ++i) {
    if (kinds[i] == ColumnKind::words) continue;
    const auto kind = kind_of(row.cells[i].text);
    if (!kind) continue;
    ++(*kind == kinds[i] ? out.values : out.words);
  }
  return out;
}

bool Sample::fits(const Row& row) const {
  if (row.cells.size() < width) return false;
  return std::all_of(row.cells.begin() + static_cast<std::ptrdiff_t>(width), row.cells.end(),
                     [](const Cell& cell) { return cell.text.empty(); });
}

// Returns the sample with the separator given by a line `sep=;`, or else with the one that makes
// most cells values. `decimal_comma`: the comma is known to be the decimal mark.
Sample sample_of(std::string_view text, bool decimal_comma) {
  const StatedSeparator stated = stated_separator(text);
  Sample best;
  double most = -1;
  for (const char separator : separators) {
    if (stated.separator != '\0' && separator != separators.front()) break;
    Sample sample =
        read_sample(text, stated.separator != '\0' ? stated.separator : separator, stated.at);
    find_width(sample);
    double plausibility = plausibility_of(sample);
    if (decimal_comma && sample.separator == ',') plausibility *= 0.2;  // below one column's
    if (plausibility <= most) continue;
    most = plausibility;
    best = std::move(sample);
  }
  if (most == 0 && stated.separator == '\0' && !best.rows.empty()) {
    const std::size_t begin = best.rows.front().at;
    const std::size_t end = std::min(text.find_first_of("\r\n", begin), text.size());
    best = read_sample(text, most_frequent(text.substr(begin, end - begin)), 0);
    find_width(best);
  }
  for (std::size_t i = 0; i < best.width; ++i) best.kinds.push_back(kind_of_column(best, i));
  return best;
}

bool all_missing(const Row& row) {
  return std::ranges::all_of(row.cells, [](const Cell& c) { return is_missing(c.text); });
}

// Returns whether a row has only units, at least one of them not a number: "s;bar;mm".
bool is_units_row(const Row& row) {
  const auto has_unit_text = [](const Cell& c) {
    return !is_missing(c.text) && !number_in(c.text);
  };
  return std::ranges::all_of(row.cells, [](const Cell& c) { return is_unit_cell(c.text); }) &&
         std::ranges::any_of(row.cells, has_unit_text);
}

// Returns the index of the first row of values; the number of rows if no row has values.
std::size_t first_value_row(const Sample& sample) {
  const std::vector<Row>& rows = sample.rows;
  if (sample.labview.present) return std::min<std::size_t>(1, rows.size());
  std::size_t first_fitting = rows.size();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!sample.fits(rows[i])) continue;
    const bool is_first = first_fitting == rows.size();
    if (is_first) first_fitting = i;
    const Sample::Tally tally = sample.tally(rows[i]);
    if (tally.values == 0) continue;
    // Some names in a header may be numbers, but not all; a row of values may have a wrong cell.
    if (tally.words > 0 && (is_first || is_units_row(rows[i]) || tally.values < tally.words))
      continue;
    while (i > 0 && sample.fits(rows[i - 1]) && all_missing(rows[i - 1])) --i;
    return i;
  }
  return std::min(first_fitting + 1, rows.size());
}

// Joins names and units that were split at blanks: "time [s]  force [N]".
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

// Reads the header of a table.
class HeaderReader {
 public:
  HeaderReader(const Sample& sample, const Source& source) : sample_(sample), source_(source) {}

  void read(Dialect& out) {
    const std::size_t first = first_value_row(sample_);
    std::size_t top = first;
    if (!source_.columns.empty()) {
      for (const std::string& column : source_.columns)
        out.header.columns.push_back(heading_of({column, 1}));
      begin_body(first < sample_.rows.size() ? first : 0, out);
      top = first < sample_.rows.size() ? first : 0;
    } else {
      top = find_names(first, out);
      begin_body(first, out);
    }
    if (sample_.rows[top].line > sample_.first_line) note_above(top, out);
  }

 private:
  // Returns the index of the first row in use.
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
    out.header.line = names.line;
    std::deque<std::string> texts;
    std::vector<Cell> cells = names.cells;
    if (sample_.separator == ' ' && cells.size() > sample_.width)
      cells = joined_units(cells, sample_.width, texts);
    while (cells.size() > 1 && cells.back().text.empty()) cells.pop_back();
    // LabVIEW names a column of remarks, which most of its rows lack.
    out.has_remarks = cells.size() > 1 && cells.back().text == "Comment";
    for (const Cell& cell : cells) out.header.columns.push_back(heading_of(cell));
    use_labview(out);
    if (!units) return;
    for (std::size_t i = 0; i < std::min(cells.size(), units->cells.size()); ++i)
      if (const std::string_view unit = without_brackets(units->cells[i].text); !unit.empty())
        out.header.columns[i].unit = unit;
  }

  // Uses the units and the clock in LabVIEW's header.
  void use_labview(Dialect& out) const {
    const LabViewHeader& header = sample_.labview;
    for (std::size_t i = 0; i < header.units.size() && i + 1 < out.header.columns.size(); ++i)
      if (out.header.columns[i + 1].unit.empty() && !without_brackets(header.units[i]).empty() &&
          is_unit_cell(header.units[i]))
        out.header.columns[i + 1].unit = without_brackets(header.units[i]);
    if (header.has_x || !(header.step > 0)) return;
    out.period = header.step;
    out.first = header.first;
    out.notes.push_back(fmt::format("times by Delta_X of its header: {} s from row to row",
                                    units::format_number(header.step)));
  }

  // Uses a comment as header, as NumPy writes it: "# time [s], force [N]".
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
      "decimal commas or grouped thousands, and which of them",
      "decimal=\",\" if the comma is the decimal mark, thousands=\",\" if it groups thousands");
}

// Returns the decimal mark: a comma if some commas can be nothing else, and at least as many as
// points.
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
      const SeparatorEvidence evidence = separator_evidence_in(row.cells[i].text);
      commas += evidence.comma ? 1 : 0;
      points += evidence.point ? 1 : 0;
      if (!evidence.either || doubtful) continue;
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
  out.header.file = source.path;
  out.separator = sample.separator;
  HeaderReader(sample, source).read(out);
  out.kinds = sample.kinds;
  out.kinds.resize(out.header.columns.size(), ColumnKind::words);
  out.numbers.decimal = decimal_of(sample, out, source);
  if (!source.thousands.empty()) out.numbers.thousands = source.thousands[0];
  return out;
}

}  // namespace sinew::recording
