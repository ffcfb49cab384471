// recording/dialect.h - how a table is written: what parts its cells, which line names its columns,
// whether its numbers have points or commas. Found from its first lines; nothing is guessed that
// could be otherwise.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/recording/number.h"
#include "sinew/recording/rows.h"
#include "sinew/recording/source.h"

namespace sinew::recording {

// What stands above a column: its name, its unit, and the condition under
// which a maker measured it.
//
//   force [N]   force (N)   force / N   force in N   "force [N] @ pressure = 1 bar gauge"

struct Heading {
  std::string name;       // force
  std::string unit;       // N, as Sinew writes it where it is known; empty where none is given
  std::string at_name;    // pressure; empty for most columns
  std::string at_value;   // 1 bar gauge
  int column = 1;         // of the header's line
  std::string written;    // all of it as the file has it
  std::string file_unit;  // the unit as the file has it: psig
  double factor = 1;      // the file's numbers times this are in `unit`: 0.001 from mbar to bar

  // Is this its name, or all of its text?
  bool is_called(std::string_view text) const { return name == text || written == text; }
};

// Reads the cell of a header: its name, its unit, and the condition behind an @.
Heading heading_of(const Cell& cell);

// Gives the heading a unit as somebody wrote it.
void set_unit(Heading& heading, std::string_view unit);

// Could the text stand in a line of units below the names? "[N]", "psig", "(mm)", "-" and nothing.
bool is_unit_cell(std::string_view text);

// The text without the brackets around a unit.
std::string_view without_brackets(std::string_view text);

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
