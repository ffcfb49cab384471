// config/migrate.h - the text of an older file in the format of today. What is not said otherwise
// today stays as it is, to the byte: comments, blanks, order, ends of lines.
#pragma once

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

}  // namespace sinew::config
