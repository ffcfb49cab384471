// files/migrate.h - conversion of a file in an older format to the current one.
//
//   files::Migration m = files::migrate("leg.toml");   // leg.toml is new, leg.toml.bak the old one
//
// Comments and layout are kept (config/migrate.h). A copy of the old file, FILE.bak, is
// written before the file is replaced, or the new one is written to another folder; a name that
// exists is refused.
#pragma once

#include <string>
#include <vector>

#include "sinew/json/json.h"

namespace sinew::files {

struct MigrateOptions {
  std::string folder;  // for the new file; empty: it replaces the old one
  bool write = true;   // false: only reports the changes
};

struct Migration {
  std::string file;                  // as given
  std::string was, is;               // old and new format: "sinew.robot/1"; `was` may be empty
  std::vector<std::string> changes;  // sentences with lines; empty: the file is unchanged
  std::string written, kept;         // new file, and new place of the old one; empty: neither
  bool is_dry = false;               // neither file is written; these are the places for them
  std::string reason;                // why a file without a Sinew format is unchanged
};

// Converts a file. Throws config::Error with all faults of the file, and log::Error if the new file
// cannot be written; the old file is then unchanged.
Migration migrate(const std::string& path, const MigrateOptions& options = {});

// Returns lines of text: the changes, then what was done with the file.
std::string text_of(const Migration& migration);

// Returns the same as a JSON object.
Json json_of(const Migration& migration);

}  // namespace sinew::files
