// recording/measured.h - a table that somebody measured: those columns of it that are wanted, as
// numbers in SI.
//
//   time [s],force [N],pressure [kPa gauge]        a header of `name [unit]`, then numbers
//   length [mm],force [N] @ pressure = 1 bar gauge,force [N] @ pressure = 2 bar gauge
//                                                  a maker's table: each such column becomes rows
//
// Separators, decimal marks, encodings and units are those of the file; what a file does not say
// its Source does. What is wrong with it - a unit, a cell, a value that cannot be - is told with
// its line, all at once.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sinew/recording/source.h"
#include "sinew/recording/text.h"

namespace sinew::recording {

// A column that a method wants.
struct Wanted {
  std::string_view name;  // "pressure"
  std::string_view unit;  // what comes out, SI: "Pa gauge"
  // Sizes that the largest value of such a measurement can have, in `unit`: beyond them the unit or
  // the column is a mistake.
  double least = 0, most = 0;
  bool optional = false;
  std::string_view doc;
  std::span<const std::pair<std::string_view, double>> words = {};  // that stand for numbers
  // A column above this one that it replaces: where that one is read, this one is left alone.
  std::string_view replaces = {};
};

// Values of one quantity, in the unit that was wanted.
struct Column {
  std::string name;  // the wanted name
  std::string unit;  // the wanted unit
  std::vector<double> values;
  std::string shown;       // unit for messages: the file's, where Sinew has it; empty: `unit`
  bool is_stated = false;  // a value for the whole file, in place of its column
};

// A table of measurements, its columns called as they were wanted.
struct Measured {
  std::string file;
  std::vector<Column> columns;
  std::vector<int> lines;          // of the file, one per row
  std::vector<std::string> notes;  // what was left out

  // How many rows there are; is there a column of that name?
  std::size_t rows() const { return lines.size(); }
  bool has(std::string_view name) const;
  // Throws std::out_of_range for a column that is not there.
  const std::vector<double>& operator[](std::string_view name) const;

  // The rows whose index is in `keep`.
  Measured subset(std::span<const std::size_t> keep) const;
};

// Throws config::Error. A wanted `time` must not run backwards or repeat itself; dates and times of
// day become seconds since the first row.
Measured read_measured(const Source& source, std::span<const Wanted> wanted);

// Reads a text in place of the file, for tests and tools; messages call it `source.path`.
Measured parse_measured(std::string_view text, const Source& source,
                        std::span<const Wanted> wanted);

}  // namespace sinew::recording
