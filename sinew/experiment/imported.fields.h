// experiment/imported.fields.h - record of the files that an imported run was made from: keys of
// [[imported]] of its resolved.toml, one entry per file. An experiment that is run from such a file
// drops it.
#pragma once

#include <string>
#include <vector>

#include "sinew/units/field.h"

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

template <class Visitor>
void fields(Visitor& v, std::vector<ImportedFile>& files) {
  v.list(
      {.name = "imported",
       .optional = true,
       .doc = "recordings that a run was made from, in a resolved file"},
      files, [](auto& g, ImportedFile& f) {
        g.text({.name = "file", .doc = "name as it was given"}, f.file);
        g.text({.name = "kind", .doc = "CSV, MCAP, MATLAB or out.dat"}, f.kind);
        g.text({.name = "size", .doc = "size of the file in bytes"}, f.size);
        g.text({.name = "crc32", .doc = "CRC-32 of the file, in hexadecimal digits"}, f.crc32);
        g.text(
            {.name = "started", .optional = true, .doc = "wall time of the start, or: not known"},
            f.started);
        g.integer({.name = "rows", .min = 0, .doc = "number of rows in the file"}, f.rows);
        g.integer({.name = "values", .min = 0, .doc = "number of values in the log"}, f.values);
        g.integer({.name = "left_out",
                   .min = 0,
                   .doc = "number of values that are not finite, or before the log's time 0"},
                  f.left_out);
      });
}

}  // namespace sinew::experiment
