#include "sinew/recording/grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "sinew/config/diagnostics.h"
#include "sinew/config/utf8.h"

namespace sinew::recording {

namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::string_view unquoted(std::string_view text) {
  const bool quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return quoted ? trimmed(text.substr(1, text.size() - 2)) : text;
}

std::vector<Cell> split(std::string_view line, char separator) {
  std::vector<Cell> cells;
  std::size_t from = 0;
  while (true) {
    std::size_t to = from;
    bool quoted = false;
    while (to < line.size() && (quoted || line[to] != separator)) quoted ^= line[to++] == '"';
    const std::string_view cell = line.substr(from, to - from);
    cells.push_back({unquoted(trimmed(cell)), static_cast<int>(from) + 1});
    if (to >= line.size()) return cells;
    from = to + 1;
  }
}

// The separator of which the line has most; a comma where it has none.
char separator_of(std::string_view line) {
  char best = ',';
  std::ptrdiff_t most = 0;
  for (const char c : {',', ';', '\t'}) {
    const std::ptrdiff_t count = std::count(line.begin(), line.end(), c);
    if (count > most) {
      most = count;
      best = c;
    }
  }
  // "0,5;1,25": commas within the cells of a semicolon's file.
  const bool both = line.find(';') != line.npos && best == ',';
  return both ? ';' : best;
}

// "force [N] @ pressure = 1 bar gauge"
Heading heading_of(const Cell& cell) {
  Heading h;
  h.column = cell.column;
  std::string_view text = cell.text;
  const std::size_t at = text.find('@');
  if (at != text.npos) {
    const std::string_view condition = text.substr(at + 1);
    const std::size_t equals = condition.find('=');
    h.at_name = trimmed(condition.substr(0, equals));
    if (equals != condition.npos) h.at_value = trimmed(condition.substr(equals + 1));
    text = trimmed(text.substr(0, at));
  }
  const std::size_t open = text.rfind('[');
  if (open != text.npos && text.back() == ']') {
    h.unit = trimmed(text.substr(open + 1, text.size() - open - 2));
    text = trimmed(text.substr(0, open));
  }
  h.name = text;
  return h;
}

void refuse_missing_header(const Grid& grid, const Row& first) {
  const bool numbers = std::all_of(first.cells.begin(), first.cells.end(), [](const Cell& c) {
    return c.text.empty() || is_number(c.text);
  });
  if (!numbers) return;
  config::fail({grid.file, first.line, 1}, "header", "numbers in the first line",
               "a header that names the columns with their units: `time [s],force [N]`",
               "columns=\"name [unit],name [unit]\" with the columns' meaning");
}

void refuse_ragged_rows(const Grid& grid) {
  const std::size_t width = grid.headings.size();
  const auto wrong = [width](const Row& r) { return r.cells.size() != width; };
  const auto first = std::find_if(grid.rows.begin(), grid.rows.end(), wrong);
  if (first == grid.rows.end()) return;
  const auto count = std::count_if(grid.rows.begin(), grid.rows.end(), wrong);
  const bool doubled = first->cells.size() == 2 * width;
  config::fail(
      {grid.file, first->line, 1}, "row",
      fmt::format("{} cells ({} such row{})", first->cells.size(), count, count == 1 ? "" : "s"),
      fmt::format("{} as in the header", width),
      doubled ? "decimal points: with decimal commas every number is cut in two"
              : "to mend these rows");
}

// Names go on into files and reports, all of which are UTF-8.
void refuse_other_encodings(const std::string& file, int line, std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = config::letter_at(text, at);
    if (length == 0)
      config::fail(
          {file, line, static_cast<int>(at) + 1}, "",
          fmt::format("a byte {:02x} that is no UTF-8", static_cast<unsigned char>(text[at])),
          "a table in UTF-8", "iconv -f LATIN1 -t UTF-8, or to save it so");
    at += length;
  }
}

}  // namespace

std::optional<double> number_in(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

bool is_number(std::string_view text) { return number_in(text).has_value(); }

Grid read_grid(std::string_view text, const std::string& file,
               const std::vector<std::string>& columns) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // a byte order mark
  Grid grid{.file = file, .header_line = 0};
  for (const std::string& column : columns) grid.headings.push_back(heading_of({column, 1}));

  char separator = '\0';
  int line = 0;
  for (std::size_t from = 0; from < text.size(); ++line) {
    const std::size_t to = std::min(text.find('\n', from), text.size());
    const std::string_view raw = text.substr(from, to - from);
    from = to + 1;
    if (trimmed(raw).empty() || trimmed(raw).front() == '#') continue;
    refuse_other_encodings(file, line + 1, raw);

    if (separator == '\0') separator = separator_of(raw);
    Row row{line + 1, split(raw, separator)};
    if (grid.headings.empty()) {
      refuse_missing_header(grid, row);
      grid.header_line = row.line;
      for (const Cell& cell : row.cells) grid.headings.push_back(heading_of(cell));
    } else {
      grid.rows.push_back(std::move(row));
    }
  }
  if (grid.rows.empty())
    config::fail({file, line, 1}, "rows", "none", "a header and rows of numbers");
  refuse_ragged_rows(grid);
  return grid;
}

}  // namespace sinew::recording
