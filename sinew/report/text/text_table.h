// report/text/text_table.h - text table with aligned columns.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sinew::report {

class TextTable {
 public:
  // Alignment of a column.
  enum class Align { left, right };

  // Creates a table with titles. `align` is that of the columns' values, by default left.
  explicit TextTable(std::vector<std::string> titles, std::vector<Align> align = {});

  // Adds a row. Throws std::logic_error for more cells than titles.
  void add(std::vector<std::string> row);
  bool empty() const { return rows_.size() == 1; }

  // Returns the width of all columns but the last, in letters.
  std::size_t width_before_last() const;

  // Returns the table with `indent` before each line. The last column is not padded.
  std::string text(std::string_view indent = "") const;

  // Returns the table within `width` letters, 0 for any: the last column is broken between its
  // words, or moved to lines of its own if little room is left.
  std::string text_within(std::size_t width) const;

 private:
  std::vector<std::size_t> widths() const;
  std::string line(const std::vector<std::string>& row, const std::vector<std::size_t>& width,
                   std::string_view indent) const;

  std::vector<std::vector<std::string>> rows_;  // titles first
  std::vector<Align> align_;
};

// Returns the number of letters of a UTF-8 text without color escapes; all count as one column
// wide.
std::size_t columns(std::string_view text);

}  // namespace sinew::report
