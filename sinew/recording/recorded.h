// recording/recorded.h - what somebody recorded, whatever kind of file it stands in: columns of
// numbers as the file names them, each with the times of its samples.
//
// Nothing is converted yet: numbers are in the file's units. A mapping (mapping.h) says what they
// mean.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/signals/table.h"

namespace sinew::recording {

// The times of some columns. Loggers with several rates, and logs of topics, have several.
struct Clock {
  std::string column;      // the file's name for them; empty: there is no such column
  signals::Times time_ns;  // as the file counts, or since `origin` [ns]
  // Time 0 of `time_ns` on the clock on the wall, UTC where there is a zone, since 1970 or, without
  // dates, since a midnight [ns]; absent: not known.
  std::optional<std::int64_t> origin;
  bool has_date = true;
  std::optional<std::int64_t> zone = {};  // local minus UTC [ns]; absent: the file gives no zone
};

// One column.
struct RecordedColumn {
  std::string name;        // "Winkel", "log.angle", "/joint/hip/angle", "/foot/position.x"
  std::string unit;        // as the file says it; empty: it does not
  std::size_t clock = 0;   // which of the clocks
  signals::Column values;  // one per time; not a number where the file has none
  bool stated = false;     // stated for the whole file, which has no such column
};

// One file.
struct Recorded {
  std::string file;
  std::string kind;     // "CSV", "MCAP", "MATLAB"
  std::string started;  // when, as the file says it or as its clock shows; empty: not known
  std::vector<Clock> clocks;
  std::vector<RecordedColumn> columns;
  std::vector<std::string> notes;  // what the reader left out or took on trust
  bool complete = true;            // false: the file was cut off

  // Returns the column of that name: as the file says it, or the only one whose name ends with it
  // behind a dot or a slash. nullptr where there is none.
  const RecordedColumn* find(std::string_view name) const;
};

}  // namespace sinew::recording
