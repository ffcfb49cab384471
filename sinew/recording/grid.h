// recording/grid.h - table of text cells under a header, not yet interpreted.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sinew/recording/dialect.h"
#include "sinew/recording/rows.h"
#include "sinew/recording/source.h"

namespace sinew::recording {

// Table with a known header. Its rows stay text until they are read, as files may be large.
struct Grid {
  std::string file;
  std::unique_ptr<const std::string> text;  // in UTF-8
  Dialect dialect;
  std::vector<std::string> notes;
  std::atomic<std::int64_t>* read = nullptr;  // the source's byte counter
  bool drop_incomplete = false;               // the source's

  // Return the header, and its columns in the order of the file.
  const Header& header() const { return dialect.header; }
  const std::vector<Heading>& headings() const { return dialect.header.columns; }

  // Returns an estimate of the number of rows, for reserving memory.
  std::size_t rows_about() const;
};

// Reads the header of a text in any encoding. Throws config::Error.
Grid read_grid(std::string bytes, const Source& source);

// Reads the rows of a grid, which must outlive it. Each row has as many cells as the header.
class Body {
 public:
  // Starts before the first row of the grid.
  explicit Body(const Grid& grid);

  // Reads the next row; counts and skips rows with another number of cells than the header.
  bool next(Row& row);

  // Throws config::Error if rows of another width were found and `drop_incomplete` is not set. A
  // short last row was cut when the logger was switched off: it is noted instead.
  void finish(std::vector<std::string>& notes) const;

  // Returns the number of rows read.
  std::size_t count() const { return count_; }

 private:
  bool fits(Row& row);
  bool is_cut_at_decimal_commas() const;

  const Grid& grid_;
  RowReader reader_;
  std::size_t count_ = 0, ragged_ = 0, dates_ = 0;
  int first_line_ = 0;            // first row that does not fit
  std::size_t first_cells_ = 0;   // number of cells in that row
  std::size_t first_digits_ = 0;  // number of these cells that are whole numbers
  std::string cut_;               // note about the last row
};

}  // namespace sinew::recording
