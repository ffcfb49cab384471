// recording/dialect.h - how a table is written: what parts its cells, which line names its columns,
// whether its numbers have points or commas. Found from its first lines; nothing is guessed that
// could be otherwise.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/recording/heading.h"
#include "sinew/recording/number.h"
#include "sinew/recording/source.h"

namespace sinew::recording {

// A column holds cells of one kind.
enum class ColumnKind { words, numbers, stamps, dates, times_of_day };

struct Dialect {
  char separator = ',';  // ' ': any number of blanks
  NumberStyle numbers;
  std::vector<Heading> headings;
  std::vector<ColumnKind> kinds;  // of the columns, as the first lines show them
  int header_line = 0;            // 0: the header came from elsewhere
  std::size_t body = 0;           // where the rows begin in the text
  int body_line = 1;
  bool has_remarks = false;        // its last column is one of remarks, which rows may lack
  double period = 0, first = 0;    // of a clock that LabVIEW's header has in place of a column [s]
  std::vector<std::string> notes;  // lines that stand before the header
};

// Returns whether a row is a date or an instant alone, as loggers write it above each recording.
bool is_date_line(const Row& row);

// Throws config::Error for a text without rows, without a header, or whose commas can be either.
Dialect dialect_of(std::string_view text, const Source& source);

}  // namespace sinew::recording
