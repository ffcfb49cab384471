// report/text/text_table.h - rows of words in columns that line up.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sinew::report {

class TextTable {
 public:
  // On which side the words of a column line up.
  enum class Align { left, right };

  // Titles of the columns; `align` is that of the values, left where it says nothing.
  explicit TextTable(std::vector<std::string> titles, std::vector<Align> align = {});

  // Throws std::logic_error for more cells than there are titles.
  void add(std::vector<std::string> row);
  bool empty() const { return rows_.size() == 1; }

  // Letters that all columns but the last need side by side.
  std::size_t width_before_last() const;

  // The last column is never padded. `indent` stands before each line.
  std::string text(std::string_view indent = "") const;

  // The same within `width` letters, 0 for any: the last column is broken between its words, or
  // stands on lines of its own where little room is left for it.
  std::string text_within(std::size_t width) const;

 private:
  std::vector<std::size_t> widths() const;
  std::string line(const std::vector<std::string>& row, std::string_view indent) const;

  std::vector<std::vector<std::string>> rows_;  // titles first
  std::vector<Align> align_;
};

// Letters of a UTF-8 text without its colors; none here is wider than one column.
std::size_t columns(std::string_view text);

}  // namespace sinew::report
