// config/migrate.h - conversion of a file's text to the current format. Everything that the format
// does not change is kept to the byte: comments, blanks, order, line ends.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/config/changes.h"

namespace sinew::config {

// Text in the current format, and the changed lines.
struct Migrated {
  std::string text;
  std::string was_kind;  // kind in the old format: "robot"
  std::string kind;      // kind in the new format
  int from = 0, to = 0;  // old and new format number; from 0: none was stated
  // Changed line.
  struct Edit {
    int line = 0;  // in the old text
    std::string was, is;
  };
  std::vector<Edit> edits;  // empty: the text is unchanged
};

// Migrates a text. `name` is the file's, used in messages and to find its `base`, which determines
// the kind of a file without a format. Throws Error if the text is not TOML, if its format is
// unknown or newer than this version, if its kind cannot be found, and for changes to be decided by
// the user.
Migrated migrated(std::string_view text, const std::string& name,
                  const Changes& changes = config::changes());

// Positions of keys in a TOML text, in bytes, so that one key can be changed and everything else is
// kept: comments, blanks, order, line ends.

// Occurrence of a key: in `key = value`, in a dotted key, or in the header of a table. A table in
// three headers has three.
struct KeyPlace {
  std::vector<std::string> path;   // segments from the root; without indices of lists
  std::size_t begin = 0, end = 0;  // range of its own segment, with quotes  [bytes]
  int line = 1;
  std::size_t value = 0;  // start of its value; 0: it is in a header or a table's name
};

// Returns the occurrences in their order. The text must be valid TOML, else the positions have no
// meaning.
std::vector<KeyPlace> key_places(std::string_view text);

// Returns the path as "joint.hip.damping".
std::string dotted(const std::vector<std::string>& path);

}  // namespace sinew::config
