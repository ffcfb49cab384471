// recording/source.h - a file of measurements, and how it is to be read: what its columns mean, and
// what the file itself does not say.
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
  std::string path;                          // a file, or the folder of a run
  std::optional<std::string> text;           // in place of the file's; `path` is what it is called
  std::vector<std::string> columns;          // "force [N]", ... for a file without a header
  std::map<std::string, std::string> names;  // wanted name -> the file's name for it
  std::map<std::string, std::string> units;  // the file's name -> its unit, for a header without
  // The same for a column that turns out to be the clock; other columns are left as they are.
  std::map<std::string, std::string> clock_units;
  // The file's name -> "fill" or "100, 200": only rows with one of these values are read.
  std::map<std::string, std::string> where;
  // "NAME=VALUE" of a wanted column that the file does not have, "pressure=2 bar gauge"; of files
  // with PART in their name: "PART:NAME=VALUE".
  std::vector<std::string> values;
  std::map<std::string, std::string> offsets;  // wanted name -> added to its numbers, "200 mm"
  bool drop_incomplete = false;                // leave out rows with cells that hold no number
  double atmosphere = units::atmosphere;       // [Pa]

  // A file may leave these open. Empty: they are read off the file, and it is refused where it does
  // not show them.
  std::string encoding;       // "utf-8", "utf-16le", "utf-16be" or "latin1"
  std::string decimal;        // "." or ","
  std::string thousands;      // what parts them: ".", ",", " " or "'"
  std::string dates;          // "day first", "month first", or "excel" for days since 1900
  std::string rate;           // "100 Hz" or "10 ms": of the rows, in place of a clock
  bool spread_times = false;  // rows that share a time are spread evenly up to the next one
  int part = 0;        // of several recordings in the file, 1 for the first; 0: there is but one
  double largest = 0;  // bytes that are read at most; 0: what this computer's memory can take
  std::atomic<std::int64_t>* read = nullptr;  // counts the bytes of the text, where somebody looks
};

// Throws config::Error for a setting whose words are none of these.
void check_settings(const Source& source);

}  // namespace sinew::recording
