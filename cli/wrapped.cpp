#include "cli/wrapped.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "cli/terminal.h"

namespace sinew::cli {

namespace {

constexpr std::size_t widest_title = 26, usual_width = 100, narrowest = 40;

std::size_t width() {
  const std::size_t columns = width_of_output();
  return columns == 0 ? usual_width : std::clamp(columns, narrowest, usual_width);
}

// Letters, not bytes, of UTF-8.
std::size_t letters(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

// Lines that begin behind `indent` blanks, the first of them without these.
std::string lines_of(std::string_view text, std::size_t indent) {
  std::istringstream in{std::string(text)};
  std::string out;
  std::size_t at = indent;
  for (std::string word; in >> word; at += letters(word)) {
    if (at > indent && at + 1 + letters(word) > width()) {
      out += "\n" + std::string(indent, ' ');
      at = indent;
    } else if (at > indent) {
      out += ' ';
      ++at;
    }
    out += word;
  }
  return out + "\n";
}

}  // namespace

std::string table(const std::vector<Row>& rows, std::size_t title_width) {
  for (const Row& row : rows)
    if (const std::size_t n = letters(row.title); n <= widest_title)
      title_width = std::max(title_width, n);
  std::string out;
  for (const Row& row : rows) {
    const std::size_t n = letters(row.title), begin = 2 + title_width + 2;
    out += "  " + row.title;
    out += n > title_width ? "\n" + std::string(begin, ' ') : std::string(begin - 2 - n, ' ');
    out += lines_of(row.words, begin);
  }
  return out;
}

std::string wrapped(std::string_view text, std::size_t indent) {
  return std::string(indent, ' ') + lines_of(text, indent);
}

}  // namespace sinew::cli
