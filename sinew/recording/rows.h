// recording/rows.h - rows of a text table as cells, read one at a time and not stored.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::recording {

struct Cell {
  std::string_view text;  // trimmed and without its quotes; a view into the text
  int column = 1;         // in the line
};

// Row of the table; a quoted cell may extend over several lines of the file.
struct Row {
  int line = 0;
  std::size_t at = 0;  // start of the row in the text [B]
  std::vector<Cell> cells;
  // Texts of cells that differ from the file's, such as one with "" for a quote. Their addresses do
  // not change when a row is moved.
  std::vector<std::unique_ptr<std::string>> mended;
};

// Reads rows from a text, which must outlive the reader. Skips empty lines and lines that begin
// with #. Lines end with \n, \r\n or \r. The separator ' ' means any number of blanks and tabs.
class RowReader {
 public:
  // Starts at byte `at`, where line number `line` begins.
  RowReader(std::string_view text, char separator, std::size_t at = 0, int line = 1)
      : text_(text), separator_(separator), at_(at), line_(line) {}

  // Reads the next row into `row`; returns false at the end of the text.
  bool next(Row& row);

  // Skips comments and empty lines; returns whether the text ends after them.
  bool at_end();

  // Return the last skipped comment, without its #, and its line.
  std::string_view comment() const { return comment_; }
  int comment_line() const { return comment_line_; }

  // Returns the number of bytes read.
  std::size_t at() const { return at_; }

 private:
  bool is_blank(char c) const { return c == ' ' || (c == '\t' && separator_ != '\t'); }
  static bool ends_line(char c) { return c == '\n' || c == '\r'; }
  void end_line();
  void skip_to_line_end();
  void skip_blanks();
  bool skip_comments();
  bool quoted_cell(Row& row, int column);
  void plain_cell(Row& row, int column);

  std::string_view text_;
  char separator_;
  std::size_t at_;
  int line_;
  std::string_view comment_;
  int comment_line_ = 0;
};

}  // namespace sinew::recording
