// config/changes.h - how the formats of files have changed: which keys were taken away, from which
// number on, and what stands in their place.
//
// A file says its format, `format = "sinew.robot/1"`. The number goes up where a file of the old
// one would mean something else, or nothing any more. What changed is a row here, and this one
// table is what a reader knows of older files (older ones are read as if they were migrated), what
// it says of a key that is gone, and what `migrate` does.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/config/node.h"

namespace sinew::config {

// A key that is no longer there.
struct KeyChange {
  std::string_view kind;  // of the file in which it stood: "robot"
  int format = 2;         // the first number without it
  std::string_view from;  // dotted, * for any name: "muscle.*.delay"
  std::string_view
      to;  // in its table: "opening_delay", "opening.delay"; empty: nothing stands there
  std::string_view why;  // where nothing does: what to do by hand
};

// A kind of file, and the number of its newest format.
struct Kind {
  std::string_view name;
  int newest = 1;             // number
  std::string_view now = {};  // the kind that took its place, at its first number; empty: none
};

struct Changes {
  std::vector<Kind> kinds;
  std::vector<KeyChange> keys;

  // nullptr where there is no such kind.
  const Kind* find(std::string_view kind) const;
};

// Those of this version.
const Changes& changes();

// `format = "sinew.robot/1"` in two parts; empty and 0 where it is none.
struct Format {
  std::string_view kind;
  int number = 0;
};
Format format_of(std::string_view text);

// The format that a file says. Throws Error where it says none, one that does not exist, or one of
// a newer version.
Format check_format(const Node& root, const Changes& changes = config::changes());

// Throws Error: the file cannot be read, is not TOML, or is an older one that cannot be migrated.
// An older one that can be is read as if it were.
Node parse_file(const std::string& path, const Changes& changes);

// The change that took a key away, as a message of the resolved namespace names it
// ("actuator.bpa.braid.turns", "reported[0].value"); nullptr if none did.
const KeyChange* taken_away(std::string_view path, const Changes& changes);

// "opening_delay, in its place since sinew.robot/2"; for Problem::try_this.
std::string in_words(const KeyChange& change);

// The kind that a file without a format seems to be, by the keys that only this kind has; empty
// where they do not tell.
std::string_view likely_kind(const Node& root);

// Do the segments of a dotted path match those of a pattern? [0] behind a list's name does not
// count.
bool matches(std::string_view path, std::string_view pattern);

}  // namespace sinew::config
