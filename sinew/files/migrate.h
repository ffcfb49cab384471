// files/migrate.h - a file of an older format becomes one of today's format.
//
//   files::Migration m = files::migrate("leg.toml");   // leg.toml is new, leg.toml.bak the old one
//
// Comments and layout stay (config/migrate.h). Nothing is overwritten: the old file is kept beside,
// or the new one goes into another folder, and a name that is taken is refused.
#pragma once

#include <string>
#include <vector>

namespace sinew::files {

struct MigrateOptions {
  std::string folder;  // for the new file; empty: in the place of the old one
  bool write = true;   // false: only tells what would be done
};

struct Migration {
  std::string file;                  // as it was named
  std::string was, is;               // its format: "sinew.robot/1"; was is empty: it said none
  std::vector<std::string> changes;  // sentences, each with its line; none: it is left alone
  std::string written, kept;         // the new file, and where the old one is now; empty: neither
  std::string reason;                // for which a file that has no format of ours is left alone
};

// Throws config::Error for all that is wrong with the file, and log::Error where the new one cannot
// be written; then the old one stands.
Migration migrate(const std::string& path, const MigrateOptions& options = {});

// Returns lines of text: what was changed, then what became of the file.
std::string text_of(const Migration& migration);

}  // namespace sinew::files
