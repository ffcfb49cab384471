#include "sinew/report/text/text_table.h"

#include <algorithm>
#include <stdexcept>

namespace sinew::report {

namespace {

// Returns lines of at most `width` letters, broken between words; a longer word has its own line.
std::vector<std::string> broken(std::string_view text, std::size_t width) {
  std::vector<std::string> lines(1);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    std::string& last = lines.back();
    if (last.empty())
      last = word;
    else if (columns(last) + 1 + columns(word) <= width)
      last += ' ' + std::string(word);
    else
      lines.emplace_back(word);
  }
  return lines;
}

}  // namespace

std::size_t columns(std::string_view text) {
  std::size_t count = 0;
  bool color = false;  // within an escape, which ends with m
  for (const char c : text) {
    color = color || c == '\033';
    if (!color && (static_cast<unsigned char>(c) & 0xC0) != 0x80) ++count;
    color = color && c != 'm';
  }
  return count;
}

TextTable::TextTable(std::vector<std::string> titles, std::vector<Align> align)
    : align_(std::move(align)) {
  align_.resize(titles.size(), Align::left);
  rows_.push_back(std::move(titles));
}

void TextTable::add(std::vector<std::string> row) {
  if (row.size() > align_.size()) throw std::logic_error("a row has more cells than its table");
  rows_.push_back(std::move(row));
}

std::vector<std::size_t> TextTable::widths() const {
  std::vector<std::size_t> out(align_.size(), 0);
  for (const auto& row : rows_)
    for (std::size_t i = 0; i < row.size(); ++i) out[i] = std::max(out[i], columns(row[i]));
  return out;
}

std::string TextTable::line(const std::vector<std::string>& row,
                            const std::vector<std::size_t>& width, std::string_view indent) const {
  std::string out(indent);
  for (std::size_t i = 0; i < row.size(); ++i) {
    const std::string padding(width[i] - columns(row[i]), ' ');
    if (i > 0) out += "  ";
    out += align_[i] == Align::right ? padding + row[i] : row[i] + padding;
  }
  out.erase(out.find_last_not_of(' ') + 1);
  return out + '\n';
}

std::string TextTable::text(std::string_view indent) const {
  const std::vector<std::size_t> width = widths();
  std::string out;
  for (const auto& row : rows_) out += line(row, width, indent);
  return out;
}

std::size_t TextTable::width_before_last() const {
  const std::vector<std::size_t> all = widths();
  std::size_t out = 0;
  for (std::size_t i = 0; i + 1 < all.size(); ++i) out += all[i] + 2;
  return out;
}

std::string TextTable::text_within(std::size_t width) const {
  constexpr std::size_t least = 20, indent = 4;
  const std::vector<std::size_t> all = widths();
  const std::size_t before = width_before_last();
  if (width == 0 || before + all.back() <= width) return text();

  const bool beside = before + least <= width;
  const std::size_t from = beside ? before : indent;
  const std::size_t room = std::max(least, width - std::min(width, from));
  std::string out;
  for (std::vector<std::string> row : rows_) {
    std::vector<std::string> last = row.size() == all.size() && !row.back().empty()
                                        ? broken(row.back(), room)
                                        : std::vector<std::string>();
    if (!last.empty()) {
      row.back() = beside ? last.front() : "";
      if (beside) last.erase(last.begin());
    }
    out += line(row, all, "");
    for (const std::string& rest : last) out += std::string(from, ' ') + rest + '\n';
  }
  return out;
}

}  // namespace sinew::report
