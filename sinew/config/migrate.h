// config/migrate.h - the text of an older file in the format of today. What is not said otherwise
// today stays as it is, to the byte: comments, blanks, order, ends of lines.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/config/changes.h"

namespace sinew::config {

// A file in today's format, and what became of its lines.
struct Migrated {
  std::string text;
  std::string was_kind;  // "robot", by the old format
  std::string kind;      // by the new one
  int from = 0, to = 0;  // number of its format; from 0: it did not say one
  // One line that reads otherwise.
  struct Edit {
    int line = 0;  // of the old text
    std::string was, is;
  };
  std::vector<Edit> edits;  // none: the text is what it was
};

// `name` is the file's, for messages and for the `base` that tells the kind of a file which does
// not. Throws Error: no TOML, an unknown format or one that is newer than this version, a file that
// does not tell what it is, and all that only a person can decide.
Migrated migrated(std::string_view text, const std::string& name,
                  const Changes& changes = config::changes());

// Where the keys of a TOML text stand in it, to the byte, so that one can be
// written otherwise and all else stays: comments, blanks, order, ends of lines.

// One mention of a key: in `key = value`, in a dotted key, in the header of a table. A table that
// is mentioned in three headers has three.
struct KeyPlace {
  std::vector<std::string> path;   // from the root; lists have no index
  std::size_t begin = 0, end = 0;  // of its own segment, quotes included  [bytes]
  int line = 1;
  std::size_t value = 0;  // where its value begins; 0: it is a header's or a table's
};

// In order of appearance. The text is TOML that the parser took: of another one the places mean
// nothing.
std::vector<KeyPlace> key_places(std::string_view text);

// "joint.hip.damping".
std::string dotted(const std::vector<std::string>& path);

}  // namespace sinew::config
