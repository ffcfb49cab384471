// recording/raw_table.h - all columns of a table as numbers, with a clock in seconds: the first
// step of an import, before the columns are given a meaning.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sinew/recording/columns.h"
#include "sinew/recording/source.h"

namespace sinew::recording {

// Column of the file under its heading. If the file has several columns of one name, the name of
// each further one is followed by a number.
struct RawColumn : Heading {
  std::vector<double> values = {};  // one per row, in the file's unit; NaN for a cell without one
  std::size_t missing = 0;          // number of NaN values
};

// Table of measurements in the order of the file.
struct RawTable {
  std::string file;
  int header_line = 0;                  // 0: the header is not in the file
  std::vector<RawColumn> columns;       // without those of the clock
  std::vector<double> time;             // since the first row  [s]; empty: the file has no clock
  double first = 0;                     // the first row's own time, if the clock holds numbers  [s]
  std::string clock;                    // columns with the times: "Zeit", "Datum and Uhrzeit"
  std::vector<Heading> clock_headings;  // headings of these columns
  std::string start;  // instant of the first row, "2026-11-24T10:15:30.125"; empty: unknown
  // Time of the first row since 1970 or, without dates, since a midnight [ns]; UTC if the table has
  // a zone.
  std::optional<std::int64_t> instant;
  bool has_date = true;
  std::optional<std::int64_t> zone;  // local minus UTC [ns]; absent: the file gives no zone
  std::vector<int> lines;            // line numbers in the file, one per row
  std::vector<std::string> notes;    // omissions and assumptions

  // Tables of further clocks: a second `Time` belongs to the columns to its right.
  std::vector<RawTable> further;

  // Returns the number of rows.
  std::size_t rows() const { return lines.size(); }
};

// Reads the source's file or text. `source.names["time"]` names the clock's column; without it the
// clock is a column of dates or times of day, or one named `time`, `t`, `Zeit` or similar.
// `source.units` holds units of columns whose header has none. A column of words is left out with a
// note. Throws config::Error with lines for cells that are neither numbers nor missing, for a clock
// with times that decrease or repeat, and for a text that is not a table.
RawTable read_table(const Source& source);

}  // namespace sinew::recording
