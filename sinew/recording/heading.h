// recording/heading.h - what stands above a column: its name, its unit, and the condition under
// which a maker measured it.
//
//   force [N]   force (N)   force / N   force in N   "force [N] @ pressure = 1 bar gauge"
#pragma once

#include <string>
#include <string_view>

#include "sinew/recording/rows.h"

namespace sinew::recording {

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

}  // namespace sinew::recording
