#include "sinew/recording/rows.h"

namespace sinew::recording {

namespace {

// A quote without a closing one within this length is an inch sign, not the start of a cell.
constexpr std::size_t longest_quoted = 64 * 1024;

}  // namespace

// Skips a line end, if there is one.
void RowReader::end_line() {
  if (at_ >= text_.size()) return;
  const bool both = text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n';
  at_ += both ? 2 : 1;
  ++line_;
}

void RowReader::skip_to_line_end() {
  while (at_ < text_.size() && !ends_line(text_[at_])) ++at_;
}

void RowReader::skip_blanks() {
  while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
}

// Stops at the first line with content; returns false at the end of the text.
bool RowReader::skip_comments() {
  while (at_ < text_.size()) {
    const std::size_t begin = at_;
    skip_blanks();
    if (at_ < text_.size() && !ends_line(text_[at_])) {
      if (text_[at_] != '#' || text_.substr(at_).starts_with("#N")) {  // "#NV" is a missing value
        at_ = begin;
        return true;
      }
      const std::size_t from = at_ + 1;
      skip_to_line_end();
      comment_ = text_.substr(from, at_ - from);
      comment_line_ = line_;
    }
    end_line();
  }
  return false;
}

bool RowReader::at_end() { return !skip_comments(); }

// Reads a quoted cell, which may contain separators, line ends and doubled quotes. Returns false,
// without reading, if the quote is part of an ordinary cell.
bool RowReader::quoted_cell(Row& row, int column) {
  bool doubled = false;
  int lines = 0;
  std::size_t to = at_ + 1;
  for (;; ++to) {
    if (to >= text_.size() || to - at_ > longest_quoted) return false;
    if (text_[to] == '\n') ++lines;
    if (text_[to] != '"') continue;
    if (to + 1 >= text_.size() || text_[to + 1] != '"') break;
    doubled = true;
    ++to;
  }
  std::size_t after = to + 1;
  while (after < text_.size() && is_blank(text_[after])) ++after;
  const bool ends = after >= text_.size() || text_[after] == separator_ ||
                    ends_line(text_[after]) || (separator_ == ' ' && after > to + 1);
  if (!ends) return false;

  std::string_view cell = text_.substr(at_ + 1, to - at_ - 1);
  if (doubled) {
    row.mended.push_back(std::make_unique<std::string>());
    std::string& mended = *row.mended.back();
    for (std::size_t i = 0; i < cell.size(); ++i) {
      mended += cell[i];
      if (cell[i] == '"') ++i;
    }
    cell = mended;
  }
  while (!cell.empty() && (cell.front() == ' ' || cell.front() == '\t')) cell.remove_prefix(1);
  while (!cell.empty() && (cell.back() == ' ' || cell.back() == '\t')) cell.remove_suffix(1);
  row.cells.push_back({cell, column});
  at_ = after;
  line_ += lines;
  return true;
}

void RowReader::plain_cell(Row& row, int column) {
  const std::size_t from = at_;
  while (at_ < text_.size() && text_[at_] != separator_ && !ends_line(text_[at_]) &&
         !(separator_ == ' ' && text_[at_] == '\t'))
    ++at_;
  std::size_t to = at_;
  while (to > from && is_blank(text_[to - 1])) --to;
  row.cells.push_back({text_.substr(from, to - from), column});
}

bool RowReader::next(Row& row) {
  row.cells.clear();
  row.mended.clear();
  if (!skip_comments()) return false;
  row.line = line_;
  row.at = at_;
  while (true) {
    const auto column = static_cast<int>(at_ - row.at) + 1;
    skip_blanks();
    const bool quoted = at_ < text_.size() && text_[at_] == '"' && quoted_cell(row, column);
    if (!quoted) plain_cell(row, column);
    if (separator_ == ' ') skip_blanks();
    if (at_ >= text_.size() || ends_line(text_[at_])) break;
    if (separator_ != ' ') ++at_;
  }
  end_line();
  return true;
}

}  // namespace sinew::recording
