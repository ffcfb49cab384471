// recording/rows.h - the lines of a table as cells, one line after the other, none of them kept.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::recording {

struct Cell {
  std::string_view text;  // trimmed and without its quotes; into the text that is read
  int column = 1;         // of the line
};

// A line of the table; a quoted cell may stretch over several lines of the file.
struct Row {
  int line = 0;
  std::size_t at = 0;  // where it begins in the text
  std::vector<Cell> cells;
  // The texts of cells that differ from the file's: "" for a quote. They stay where they are when
  // a row is moved.
  std::vector<std::unique_ptr<std::string>> mended;
};

// Reads rows from a text that outlives it. Empty lines are skipped, and those that begin with #.
// Lines end with \n, \r\n or \r. The separator ' ' stands for any number of blanks and tabs.
class RowReader {
 public:
  // Begins at byte `at`, which begins the line number `line`.
  RowReader(std::string_view text, char separator, std::size_t at = 0, int line = 1)
      : text_(text), separator_(separator), at_(at), line_(line) {}

  // Reads the next row into `row`; false at the end of the text.
  bool next(Row& row);

  // Is there nothing more than comments and empty lines? They are skipped.
  bool at_end();

  // Returns the last comment that was skipped, without its #, and its line.
  std::string_view comment() const { return comment_; }
  int comment_line() const { return comment_line_; }

  // Returns how many bytes were read.
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
