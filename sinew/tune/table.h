// tune/table.h - a sweep's rows as CSV and JSON, and their file.
#pragma once

#include <exception>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/log/replacement.h"
#include "sinew/run/folder/files.h"
#include "sinew/tune/sweep.h"

namespace sinew::tune {

// Returns a line of CSV with its line end; cells are quoted where necessary.
std::string csv_line(const std::vector<std::string>& cells);

// Returns the table in format sinew.sweep/1, an object per row; numbers and flags are not quoted.
std::string json_of(const std::vector<std::string>& headings, const std::vector<Row>& rows);

// Kind of a table's file, whose last column is the status of a row.
inline constexpr run::FileKind table_kind{"table of runs", "such a table", "status",
                                          run::FileKind::At::end_of_first_line};

// The file of a table. Rows are written at once into a temporary file next to the final one,
// so that they survive if the sweep is killed. It is created with the first row: a refused sweep
// leaves no file.
class TableFile {
 public:
  // Throws config::Error like run::refuse_to_overwrite().
  TableFile(const std::filesystem::path& file, std::vector<std::string> headings, bool force,
            const std::vector<std::filesystem::path>& inputs = {},
            const run::FileKind& kind = table_kind);

  // Passes each line to `print` instead of a file.
  TableFile(std::vector<std::string> headings, std::function<void(std::string_view)> print);

  // Adds a row, also while other runs continue. Returns false after a failure, which is stored for
  // throw_failure().
  bool add(const std::vector<std::string>& cells) noexcept;

  // Throws std::runtime_error if a row could not be written.
  void throw_failure() const;

  // Returns the path of the file with the rows of an incomplete table; empty without a file.
  std::string part() const { return file_ ? file_->part().string() : name_.string(); }

  // Completes the table, which then replaces an older one. Throws log::Error.
  void take_place();

 private:
  std::filesystem::path name_;
  std::vector<std::string> headings_;
  std::function<void(std::string_view)> print_;
  bool begun_ = false;
  std::optional<log::Replacement> file_;
  std::exception_ptr failure_;
};

// Writes all rows to a file; nothing if it has no name. Throws like TableFile.
void write_table(const std::string& file, const std::vector<std::string>& headings,
                 const std::vector<std::vector<std::string>>& rows, bool force,
                 const std::vector<std::filesystem::path>& inputs, const run::FileKind& kind);

// Returns warnings about rows without figures, and about trolleys that reached their track's end.
std::vector<std::string> warnings(const std::vector<Row>& rows);

// Throws config::Error for figures that no row has: their name is wrong, or they are those of
// another machine. Throws std::runtime_error if no row has figures.
void refuse_empty_columns(const std::vector<Row>& rows, const Sweep& sweep);

}  // namespace sinew::tune
