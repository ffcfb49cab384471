// experiment/imported.h - what says of a run that it was recorded elsewhere: [[imported]] of its
// resolved.toml, one for each file. An experiment that is run from such a file drops it.
#pragma once

#include <string>
#include <vector>

namespace sinew::experiment {

// One recording that a run was made of.
struct ImportedFile {
  std::string file;                   // as it was named
  std::string kind;                   // CSV, MCAP, MATLAB, out.dat
  std::string size;                   // "1048576 bytes"
  std::string crc32;                  // of its bytes, eight hexadecimal digits
  std::string started = "not known";  // on the clock on the wall
  int rows = 0;
  int values = 0;    // that went into the log
  int left_out = 0;  // that are no numbers, or stand before the log's time 0
};

}  // namespace sinew::experiment
