// recording/grid.h - a CSV file as cells of text under a header, before anybody asks what
// they mean.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::recording {

struct Cell {
  std::string_view text;  // trimmed; into the text that was read
  int column = 1;         // of the line
};

// "force [N] @ pressure = 1 bar gauge"
struct Heading {
  std::string name;      // force
  std::string unit;      // N; empty where the header gives none
  std::string at_name;   // pressure; empty for most columns
  std::string at_value;  // 1 bar gauge
  int column = 1;        // of the header's line
};

// A line of the table.
struct Row {
  int line = 0;
  std::vector<Cell> cells;
};

// A table as the file has it, not yet understood.
struct Grid {
  std::string file;
  int header_line = 1;  // 0: the header came from elsewhere
  std::vector<Heading> headings;
  std::vector<Row> rows;
};

// `columns`: the header, for a file that has none. Throws config::Error. Separators are commas,
// semicolons or tabs, as in the first line; lines that begin with # and empty lines are skipped.
Grid read_grid(std::string_view text, const std::string& file,
               const std::vector<std::string>& columns);

// Is the text a number?
bool is_number(std::string_view text);
std::optional<double> number_in(std::string_view text);  // nothing where it is none

}  // namespace sinew::recording
