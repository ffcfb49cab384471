// recording/source.h - file of measurements and the settings for reading it: what its columns mean,
// and what the file does not state.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sinew/units/constants.h"

namespace sinew::recording {

struct Source {
  std::string path;                  // a file, or the folder of a run
  std::optional<std::string> text;   // replaces the file's content; `path` then only names it
  std::vector<std::string> columns;  // "force [N]", ... for a file without a header
  std::map<std::string, std::string> names;  // name in ColumnSpec -> the file's name
  std::map<std::string, std::string> units;  // the file's name -> its unit, if the header has none
  // Like `units`, but only for the column that is the clock; ignored for other columns.
  std::map<std::string, std::string> clock_units;
  // The file's name -> "fill" or "100, 200": only rows with one of these values are read.
  std::map<std::string, std::string> where;
  // "NAME=VALUE" for a column that the file lacks, "pressure=2 bar gauge", or "PART:NAME=VALUE" for
  // files with PART in their name.
  std::vector<std::string> values;
  std::map<std::string, std::string>
      offsets;                            // name in ColumnSpec -> added to its numbers, "200 mm"
  bool drop_incomplete = false;           // leave out rows with cells without a number
  double atmosphere = units::atmosphere;  // [Pa]

  // Format settings that a file may leave open. Empty: found from the file, which is refused if
  // they cannot be determined.
  std::string encoding;       // "utf-8", "utf-16le", "utf-16be" or "latin1"
  std::string decimal;        // "." or ","
  std::string thousands;      // thousands separator: ".", ",", " " or "'"
  std::string dates;          // "day first", "month first", or "excel" for days since 1900
  std::string rate;           // rate or period of the rows in place of a clock: "100 Hz", "10 ms"
  bool spread_times = false;  // rows that share a time are spread evenly up to the next one
  int part = 0;               // index of the recording in the file, from 1; 0: the only one
  double largest = 0;         // limit for the file's size [B]; 0: a share of this computer's memory
  std::atomic<std::int64_t>* read = nullptr;  // if set, counts the bytes of the text that were read
};

// Throws config::Error for a setting with a value that is not allowed.
void check_settings(const Source& source);

}  // namespace sinew::recording
