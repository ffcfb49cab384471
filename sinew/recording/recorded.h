// recording/recorded.h - recording in any file format: columns of numbers under the file's names,
// each with the times of its samples.
//
// Nothing is converted yet: numbers are in the file's units. A mapping (mapping.h) defines their
// meaning.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sinew/recording/columns.h"
#include "sinew/recording/mapping.h"
#include "sinew/recording/source.h"
#include "sinew/signals/table.h"

namespace sinew::recording {

// Times of some columns. Loggers with several rates and logs of topics have several clocks.
struct Clock {
  std::string column;      // the file's name; empty: there is no such column
  signals::Times time_ns;  // as counted in the file, or since `origin` [ns]
  // Wall-clock time of time 0 in `time_ns`, since 1970, or since a midnight if there is no date
  // [ns]. It is UTC if the zone is known. Absent: unknown.
  std::optional<std::int64_t> origin;
  bool has_date = true;
  std::optional<std::int64_t> zone = {};  // local minus UTC [ns]; absent: the file gives no zone
  std::vector<Heading> headings = {};     // headings of columns with the times

  // Returns whether a user may call the clock, or one of its columns, by this name.
  bool is_called(std::string_view name) const {
    return column == name || Header{.columns = headings}.find(name).has_value();
  }
};

// Column of a recording, named "Winkel", "log.angle", "/joint/hip/angle" or "/foot/position.x".
struct RecordedColumn : Heading {
  std::size_t clock = 0;   // index in Recorded::clocks
  signals::Column values;  // one per time; NaN where the file has no value
  bool stated = false;     // value for the whole file, instead of a column
};

// Recording read from one file.
struct Recorded {
  std::string file;
  std::string kind;     // "CSV", "MCAP", "MATLAB"
  std::string started;  // as given in the file or by its clock; empty: unknown
  int header_line = 0;  // 0: the file has no header
  std::vector<Clock> clocks;
  std::vector<RecordedColumn> columns;
  std::vector<std::string> notes;  // the reader's omissions and assumptions
  bool complete = true;            // false: the file was cut off

  // Returns the names and units of the columns.
  Header header() const { return {file, header_line, {columns.begin(), columns.end()}}; }
};

// --- reading; the format is recognised by the file's first bytes, not by its name ---
//
//   CSV      tables of text in all supported formats (raw_table.h)
//   MCAP     logs of Sinew and of other programs, with messages in JSON
//   MATLAB   .mat of level 5 and 7.3 (matlab.h)

// Reads one file. Uses the mapping's clock, table settings and row conditions. Throws config::Error
// and log::Error if it cannot be read, and names other formats that it recognises, such as a
// workbook or an archive. `read` counts the bytes read from the rows of a text table.
Recorded read_recording(const std::string& path, const Mapping& mapping,
                        std::atomic<std::int64_t>* read = nullptr);

// Returns the settings of a mapping for the table reader.
Source source_of(const std::string& path, const Mapping& mapping);

// Value given for a whole file, in place of a column: "pressure=2 bar gauge", or
// "p200:pressure=2 bar gauge" for files with p200 in their name.
struct Stated {
  std::string part, name, value;

  // Returns whether the value applies to that file.
  bool is_for(const std::string& file) const;
};

// Parses such a text. Throws config::Error if the name or the value is missing.
Stated stated_in(const std::string& text);

// Adds a column for each value that applies to the file, with the name of its channel and the
// times of the first clock. Throws config::Error for a value that is not a number with a unit.
void add_stated(const std::vector<std::string>& values, Recorded& file);

// Throws config::Error if a value's part occurs in no file name, which is most likely a typing
// error.
void check_stated(const std::vector<std::string>& values, const std::vector<std::string>& files);

}  // namespace sinew::recording
