// recording/raw_table.h - every column of somebody's table as numbers, with a clock in seconds:
// what an import begins with, before anybody says what the columns mean.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sinew/recording/source.h"

namespace sinew::recording {

// A column of the file. Its numbers are in `unit`; a cell that holds none is NaN.
struct RawColumn {
  std::string name;            // "force", of "force [N]"
  std::string unit;            // as Sinew writes it, "psi gauge" for "psig"; empty: none is given
  bool known_unit = false;     // is `unit` one of Sinew's? "bar" is, and still lacks its reference
  std::string header;          // as the file has it: "Kraft (N)"
  std::vector<double> values;  // one per row
  std::size_t missing = 0;     // how many of them are NaN
};

// A table of measurements in the order of the file.
struct RawTable {
  std::string file;
  std::vector<RawColumn> columns;  // without those of the clock
  std::vector<double> time;        // since the first row  [s]; empty where the file has no clock
  double first = 0;                // the first row's own, of a clock of numbers  [s]
  std::string clock;               // what the times are from: "column Zeit", "rate 100 Hz"
  std::string start;               // of the first row, "2026-11-24T10:15:30.125"; empty: unknown
  // The same since 1970 or, without dates, since a midnight [ns]; UTC if the table has a zone.
  std::optional<std::int64_t> instant;
  bool has_date = true;
  std::optional<std::int64_t> zone;  // local minus UTC [ns]; absent: the file gives no zone
  std::vector<int> lines;            // of the file, one per row
  std::vector<std::string> notes;    // what was left out, and what was taken for granted

  // Columns of further clocks: a second `Time` is that of the columns to its right.
  std::vector<RawTable> further;

  // Returns how many rows there are.
  std::size_t rows() const { return lines.size(); }
};

// Reads the source's file or text. `source.names["time"]` names the clock's column; without it a
// column of dates or times of day is the clock, or one that is called `time`, `t`, `Zeit` or the
// like. `source.units` holds units of columns whose header has none. A column of words is left out
// with a note. Throws config::Error, which tells lines, for cells that are neither numbers nor
// missing, for a clock that runs backwards or repeats itself, and for what no table is.
RawTable read_table(const Source& source);

}  // namespace sinew::recording
