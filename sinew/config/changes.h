// config/changes.h - history of the file formats: the keys that were removed, the format that
// removed them, and their replacements.
//
// A file states its format, `format = "sinew.robot/1"`. The number increases if a file of the old
// format would mean something else or nothing. Each change is a row in this table, which is used to
// read older files (as if they were migrated), to report removed keys, and by `migrate`.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/config/node.h"

namespace sinew::config {

// Removed key.
struct KeyChange {
  std::string_view kind;  // kind of file that had it: "robot"
  int format = 2;         // first format number without it
  std::string_view from;  // dotted, * is any name: "muscle.*.delay"
  std::string_view to;    // replacement in its table: "opening_delay", "opening.delay"; empty: none
  std::string_view why;   // without a replacement: what to do by hand
};

// Kind of file and the number of its newest format.
struct Kind {
  std::string_view name;
  int newest = 1;             // newest format number
  std::string_view now = {};  // kind that replaced it, at that kind's first format; empty: none
};

struct Changes {
  std::vector<Kind> kinds;
  std::vector<KeyChange> keys;

  // Returns the kind, or nullptr if it is unknown.
  const Kind* find(std::string_view kind) const;
};

// Returns the changes of this version.
const Changes& changes();

// Returns "sinew.robot/1" of "robot", with the newest number; a kind that was replaced has the
// format of its replacement. Throws std::invalid_argument for an unknown kind.
std::string newest_format(std::string_view kind, const Changes& changes = config::changes());

// Parts of `format = "sinew.robot/1"`; empty and 0 for another text.
struct Format {
  std::string_view kind;
  int number = 0;
};
Format format_of(std::string_view text);

// Returns the format that a file states. Throws Error if it states none, an unknown one, or one of
// a newer version.
Format check_format(const Node& root, const Changes& changes = config::changes());

// Parses a file; an older file is read as if it were migrated. Throws Error if the file cannot be
// read, is not TOML, or cannot be migrated.
Node parse_file(const std::string& path, const Changes& changes);

// Returns the change that removed a key, given by its path in the resolved namespace
// ("actuator.bpa.braid.turns", "reported[0].value"); nullptr if none did.
const KeyChange* removed_key(std::string_view path, const Changes& changes);

// Returns "muscle.a.opening_delay, which replaces it since sinew.robot/2", for Problem::try_this.
// `path` is the key that was found.
std::string replacement_text(const KeyChange& change, std::string_view path);

// Returns "KEY=VALUE" of a plan or a tuning with the key that replaced KEY; unchanged if none did.
// Such texts name keys of an experiment, whose format they do not state.
std::string with_present_key(const std::string& setting,
                             const Changes& changes = config::changes());

// Returns the likely kind of a file without a format, found from keys that only this kind has;
// empty if no such key is found.
std::string_view likely_kind(const Node& root);

// Returns whether the segments of a dotted path match a pattern. The index after a list's name is
// ignored.
bool matches(std::string_view path, std::string_view pattern);

}  // namespace sinew::config
