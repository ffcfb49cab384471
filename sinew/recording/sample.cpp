#include "sinew/recording/sample.h"

#include <algorithm>
#include <array>
#include <map>

#include "sinew/recording/stamp.h"

namespace sinew::recording {

namespace {

// Enough to see commas, units and clocks; little enough to be read once for each separator.
constexpr std::size_t most_rows = 400, most_bytes = 1 << 20;

// Where two make as much sense, the earlier one is preferred.
constexpr std::array separators{'\t', ';', ',', ' '};

// A first line that tells spreadsheets the separator, and where the table begins behind it.
struct SaidSeparator {
  char separator = '\0';
  std::size_t at = 0;
};
SaidSeparator said_separator(std::string_view text) {
  const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
  std::string_view line = text.substr(0, end);
  if (line.size() > 2 && line.front() == '"' && line.back() == '"')
    line = line.substr(1, line.size() - 2);
  const bool said = line.size() == 5 && (line.starts_with("sep=") || line.starts_with("SEP=") ||
                                         line.starts_with("Sep="));
  if (!said) return {};
  std::size_t next = end;
  if (next < text.size()) next += text.substr(next).starts_with("\r\n") ? 2 : 1;
  return {line[4], next};
}

// A line of LabVIEW's header: a key, then its value, or one for each column.
void take_labview(const Row& line, LabViewHeader& out) {
  out.is_there = true;
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
    // LabVIEW's own table begins behind the last of these.
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

// The later half: what stands above a header is at the begin.
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

ColumnKind kind_of_column(const Sample& sample, std::size_t column) {
  std::map<ColumnKind, std::size_t> counts;
  for (std::size_t i = later_half(sample); i < sample.rows.size(); ++i) {
    const Row& row = sample.rows[i];
    if (row.cells.size() != sample.width) continue;
    if (const auto kind = kind_of(row.cells[column].text)) ++counts[*kind];
  }
  if (counts.empty()) return ColumnKind::numbers;  // nothing but missing values
  // Lines of units and names may be among few rows: words must be more than all values.
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

// Returns the share of values among the cells of usual rows; a quarter of it for one column, as
// every text makes one.
double sense_of(const Sample& sample) {
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

// The separator of which the first line has most; a comma where it has none.
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

}  // namespace

std::optional<ColumnKind> kind_of(std::string_view cell) {
  if (is_missing(cell)) return std::nullopt;
  if (marks_in(cell).number) return ColumnKind::numbers;
  const std::optional<Stamp> stamp = stamp_in(cell);
  if (!stamp) return ColumnKind::words;
  if (!stamp->has_date) return ColumnKind::times_of_day;
  return stamp->has_time ? ColumnKind::stamps : ColumnKind::dates;
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

Sample sample_of(std::string_view text, bool decimal_comma) {
  const SaidSeparator said = said_separator(text);
  Sample best;
  double most = -1;
  for (const char separator : separators) {
    if (said.separator != '\0' && separator != separators.front()) break;
    Sample sample = read_sample(text, said.separator != '\0' ? said.separator : separator, said.at);
    find_width(sample);
    double sense = sense_of(sample);
    if (decimal_comma && sample.separator == ',') sense *= 0.2;  // below a column of its own
    if (sense <= most) continue;
    most = sense;
    best = std::move(sample);
  }
  if (most == 0 && said.separator == '\0' && !best.rows.empty()) {
    const std::size_t begin = best.rows.front().at;
    const std::size_t end = std::min(text.find_first_of("\r\n", begin), text.size());
    best = read_sample(text, most_frequent(text.substr(begin, end - begin)), 0);
    find_width(best);
  }
  for (std::size_t i = 0; i < best.width; ++i) best.kinds.push_back(kind_of_column(best, i));
  return best;
}

}  // namespace sinew::recording
