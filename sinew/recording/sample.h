// recording/sample.h - the first rows of a table as cells, parted as most of them make sense.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "sinew/recording/dialect.h"
#include "sinew/recording/rows.h"

namespace sinew::recording {

// Holds the clock and units that the header of a LabVIEW table gives for its rows.
struct LabViewHeader {
  bool is_there = false, has_x = true;
  double step = 0, first = 0;      // Delta_X and X0  [s]
  char decimal = '\0';             // '\0': not given
  std::vector<std::string> units;  // of the columns behind X_Value
};

struct Sample {
  LabViewHeader labview;
  char separator = ',';
  int first_line = 0;             // that holds something
  std::vector<Row> rows;          // of these and the following lines
  std::size_t width = 0;          // cells of most rows, those of the header and above it apart
  std::vector<ColumnKind> kinds;  // of each of these cells
  std::string_view comment;       // the last one before the first row
  int comment_line = 0;

  // How many cells of a row hold what their columns do, and how many something else; columns of
  // words apart.
  struct Tally {
    std::size_t values = 0, words = 0;
  };
  Tally tally(const Row& row) const;

  // Has the row as many cells as most, or more that are empty?
  bool fits(const Row& row) const;
};

// Returns the kind of what a cell holds; nothing where its value is missing.
std::optional<ColumnKind> kind_of(std::string_view cell);

// A line `sep=;` says the separator; without it, it is the one by which most cells are values.
// `decimal_comma`: a comma is the decimal mark, for certain.
Sample sample_of(std::string_view text, bool decimal_comma);

}  // namespace sinew::recording
