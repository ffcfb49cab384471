// experiment/imported.fields.h - keys of [[imported]] in a resolved file.
#pragma once

#include <vector>

#include "sinew/experiment/imported.h"
#include "sinew/units/field.h"

namespace sinew::experiment {

template <class Visitor>
void fields(Visitor& v, std::vector<ImportedFile>& files) {
  v.list(
      {.name = "imported",
       .optional = true,
       .doc = "the recordings that a run was made of, in a resolved file"},
      files, [](auto& g, ImportedFile& f) {
        g.text({.name = "file", .doc = "as it was named"}, f.file);
        g.text({.name = "kind", .doc = "CSV, MCAP, MATLAB or out.dat"}, f.kind);
        g.text({.name = "size", .doc = "of the file, in bytes"}, f.size);
        g.text({.name = "crc32", .doc = "of its bytes, in hexadecimal digits"}, f.crc32);
        g.text(
            {.name = "started", .optional = true, .doc = "on the clock on the wall, or: not known"},
            f.started);
        g.integer({.name = "rows", .min = 0, .doc = "of the file"}, f.rows);
        g.integer({.name = "values", .min = 0, .doc = "that went into the log"}, f.values);
        g.integer({.name = "left_out",
                   .min = 0,
                   .doc = "values that are not finite, or before the log's time 0"},
                  f.left_out);
      });
}

}  // namespace sinew::experiment
