// recording/dialect.h - format of a text table: its separator, the line of its column names, and
// its decimal mark. The format is found from the first lines; a table that allows two readings is
// refused, never guessed.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/recording/number.h"
#include "sinew/recording/rows.h"
#include "sinew/recording/source.h"

namespace sinew::recording {

// Heading of a column: its name, its unit, and the condition under which its values were measured.
//
//   force [N]   force (N)   force / N   force in N   "force [N] @ pressure = 1 bar gauge"

struct Heading {
  std::string name;       // force
  std::string unit;       // N, in Sinew's spelling where it is a known unit; empty: not given
  std::string at_name;    // pressure; empty for most columns
  std::string at_value;   // 1 bar gauge
  int column = 1;         // in the header's line
  std::string written;    // whole cell as in the file
  std::string file_unit;  // the unit as in the file: psig
  double factor = 1;      // the file's numbers times this are in `unit`: 0.001 from mbar to bar

  // Returns whether `text` is the heading's name or its whole text.
  bool is_called(std::string_view text) const { return name == text || written == text; }
};

// Reads a header cell: name, unit, and the condition after an @.
Heading heading_of(const Cell& cell);

// Sets the heading's unit from any accepted spelling.
void set_unit(Heading& heading, std::string_view unit);

// Returns whether the text can be a cell of a units line below the names: "[N]", "psig", "(mm)",
// "-" or empty.
bool is_unit_cell(std::string_view text);

// Returns the text without brackets around a unit.
std::string_view without_brackets(std::string_view text);

// Kind of the cells of a column.
enum class ColumnKind { words, numbers, stamps, dates, times_of_day };

struct Dialect {
  char separator = ',';  // ' ': any number of blanks
  NumberStyle numbers;
  std::vector<Heading> headings;
  std::vector<ColumnKind> kinds;  // column kinds, found from the first lines
  int header_line = 0;            // 0: the header is not in the file
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
