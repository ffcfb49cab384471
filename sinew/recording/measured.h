// recording/measured.h - selected columns of a measured table as numbers in SI.
//
//   time [s],force [N],pressure [kPa gauge]        a header of `name [unit]`, then numbers
//   length [mm],force [N] @ pressure = 1 bar gauge,force [N] @ pressure = 2 bar gauge
//                                                  a maker's table: each such column becomes rows
//
// Separators, decimal marks, encodings and units are those of the file; Source supplies what the
// file does not state. All faults, such as a wrong unit, cell or value, are reported together with
// their lines.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sinew/recording/source.h"
#include "sinew/recording/text.h"

namespace sinew::recording {

// Column that a method requires.
struct ColumnSpec {
  std::string_view name;  // "pressure"
  std::string_view unit;  // SI unit of the values that are returned: "Pa gauge"
  // Range of the largest absolute value of such a measurement, in `unit`; outside it the unit or
  // the column is wrong.
  double least = 0, most = 0;
  bool optional = false;
  std::string_view doc;
  std::span<const std::pair<std::string_view, double>> words = {};  // words that mean numbers
  // Column earlier in the list that this one replaces: if that one is read, this one is skipped.
  std::string_view replaces = {};
};

// Values of one quantity, in the requested unit.
struct Column {
  std::string name;  // name in ColumnSpec
  std::string unit;  // unit in ColumnSpec
  std::vector<double> values;
  std::string shown;       // unit for messages: the file's, if Sinew has it; empty: `unit`
  bool is_stated = false;  // one value for the whole file, instead of a column
};

// Table of measurements, with columns named as in ColumnSpec.
struct Measured {
  std::string file;
  std::vector<Column> columns;
  std::vector<int> lines;  // line numbers in the file, one per row
  // For rows that are averages: independent readings behind each, and their variance in the
  // response. Empty: each row is one reading.
  std::vector<double> weights, variances;
  std::vector<std::string> notes;  // parts that were left out

  // Return the number of rows, and whether there is a column of that name.
  std::size_t rows() const { return lines.size(); }
  bool has(std::string_view name) const;
  // Returns the values of a column. Throws std::out_of_range if it was not read.
  const std::vector<double>& operator[](std::string_view name) const;

  // Returns the rows whose index is in `keep`.
  Measured subset(std::span<const std::size_t> keep) const;
};

// Reads the wanted columns of the source. Throws config::Error. A wanted `time` must neither
// decrease nor repeat; dates and times of day become seconds since the first row.
Measured read_measured(const Source& source, std::span<const ColumnSpec> specs);

// Reads a text in place of the file, for tests and tools; messages use `source.path` as its name.
Measured parse_measured(std::string_view text, const Source& source,
                        std::span<const ColumnSpec> specs);

}  // namespace sinew::recording
