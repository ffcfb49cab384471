// recording/dialect.h - format of a text table: its separator, the line of its column names, and
// its decimal mark. The format is found from the first lines; a table that allows two readings is
// refused, never guessed.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/recording/columns.h"
#include "sinew/recording/number.h"
#include "sinew/recording/rows.h"
#include "sinew/recording/source.h"

namespace sinew::recording {

// Kind of the cells of a column.
enum class ColumnKind { words, numbers, stamps, dates, times_of_day };

struct Dialect {
  char separator = ',';  // ' ': any number of blanks
  NumberStyle numbers;
  Header header;
  std::vector<ColumnKind> kinds;  // column kinds, found from the first lines
  std::size_t body = 0;           // start of the first row in the text [B]
  int body_line = 1;
  bool has_remarks = false;        // whether the last column holds remarks, which rows may lack
  double period = 0, first = 0;    // clock defined by LabVIEW's header, without a column [s]
  std::vector<std::string> notes;  // lines above the header
};

// Returns whether a row holds only a date or an instant, as loggers write it above each recording.
bool is_date_line(const Row& row);

// Finds the format of a table. Throws config::Error for a text without rows or header, and if
// commas may be decimal marks or thousands separators.
Dialect dialect_of(std::string_view text, const Source& source);

}  // namespace sinew::recording
