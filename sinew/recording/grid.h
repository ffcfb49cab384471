// recording/grid.h - a table as cells of text under a header, before anybody asks what they mean.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/recording/dialect.h"
#include "sinew/recording/rows.h"
#include "sinew/recording/source.h"

namespace sinew::recording {

// A table whose header is known. Its rows stay text until somebody reads them, as files may be
// large.
struct Grid {
  std::string file;
  std::unique_ptr<const std::string> text;  // in UTF-8
  Dialect dialect;
  std::vector<std::string> notes;
  std::atomic<std::int64_t>* read = nullptr;  // the source's
  bool drop_incomplete = false;               // the source's

  // Returns the columns, in the order of the file.
  const std::vector<Heading>& headings() const { return dialect.headings; }
  int header_line() const { return dialect.header_line; }  // 0: the header came from elsewhere

  // About how many rows there are, to make room for them.
  std::size_t rows_about() const;
};

// Reads the header of a text in any encoding. Throws config::Error.
Grid read_grid(std::string bytes, const Source& source);

// Reads the rows of a grid, which outlives it. Each has as many cells as the header.
class Body {
 public:
  // Stands before the first row of the grid.
  explicit Body(const Grid& grid);

  // Reads the next row; rows with other numbers of cells are counted and passed over.
  bool next(Row& row);

  // Throws config::Error if there was such a row and rows that are not complete are not to be left
  // out. A last one that is short was cut when the logger was switched off: that is noted.
  void finish(std::vector<std::string>& notes) const;

  // Returns how many rows were read.
  std::size_t count() const { return count_; }

 private:
  bool fits(Row& row);
  bool is_cut_at_decimal_commas() const;

  const Grid& grid_;
  RowReader reader_;
  std::size_t count_ = 0, ragged_ = 0, dates_ = 0;
  int first_line_ = 0;            // of the rows that do not fit
  std::size_t first_cells_ = 0;   // of that row
  std::size_t first_digits_ = 0;  // of these cells those that are whole numbers
  std::string cut_;               // what is to be noted of the last row
};

}  // namespace sinew::recording
