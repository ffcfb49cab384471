// tune/table.h - a sweep's rows as CSV and JSON, and the file that they become.
#pragma once

#include <exception>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/log/replacement.h"
#include "sinew/tune/sweep.h"

namespace sinew::tune {

// Returns a line of CSV with its end; quotes stand where a cell needs them.
std::string csv_line(const std::vector<std::string>& cells);

// Returns the table in format sinew.sweep/1, an object a row; numbers and flags as such.
std::string json_of(const std::vector<std::string>& headings, const std::vector<Row>& rows);

// TableFile holds the rows as they come, so that a sweep that is killed leaves them, beside the
// file that they become. The file beside is made with the first row: a sweep that is refused leaves
// nothing.
class TableFile {
 public:
  // Throws config::Error where `file` exists, unless `force`, or is one of `inputs`.
  TableFile(const std::filesystem::path& file, std::vector<std::string> headings, bool force,
            const std::vector<std::filesystem::path>& inputs = {});

  // Without a file, each line is handed to `print`.
  TableFile(std::vector<std::string> headings, std::function<void(std::string_view)> print);

  // Adds a row, between runs that go on; a failure is kept for throw_failure(). Returns false where
  // there was one.
  bool add(const std::vector<std::string>& cells) noexcept;

  // Throws std::runtime_error where a row could not be written.
  void throw_failure() const;

  // Returns the file that holds the rows of a table that is not whole; empty without a file.
  std::string part() const { return file_ ? file_->part().string() : name_.string(); }

  // The table is whole: it takes the place of an older one. Throws log::Error.
  void take_place();

 private:
  std::filesystem::path name_;
  std::vector<std::string> headings_;
  std::function<void(std::string_view)> print_;
  bool begun_ = false;
  std::optional<log::Replacement> file_;
  std::exception_ptr failure_;
};

// Returns what is to be said of rows without figures, or whose trolley reached its track's end.
std::vector<std::string> warnings(const std::vector<Row>& rows);

// Throws config::Error for figures that no row has: they were asked for under a name that is none,
// or of a machine that does not have them. Throws std::runtime_error where no row has figures.
void refuse_empty_columns(const std::vector<Row>& rows, const Sweep& sweep);

}  // namespace sinew::tune
