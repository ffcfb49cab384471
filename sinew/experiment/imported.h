// experiment/imported.h - record of the files that an imported run was made from: [[imported]] of
// its resolved.toml, one entry per file. An experiment that is run from such a file drops it.
#pragma once

#include <string>
#include <vector>

namespace sinew::experiment {

// A recording that a run was made from.
struct ImportedFile {
  std::string file;                   // name as the user gave it
  std::string kind;                   // CSV, MCAP, MATLAB, out.dat
  std::string size;                   // "1048576 bytes"
  std::string crc32;                  // checksum of its bytes, eight hexadecimal digits
  std::string started = "not known";  // wall time
  int rows = 0;
  int values = 0;    // values that went into the log
  int left_out = 0;  // values that are not finite, or precede the log's time 0
};

}  // namespace sinew::experiment
