// files/keys.h - list of all keys of Sinew's TOML files: type, range, default and description.
//
//   for (const files::Key& key : files::find_keys({"damping"}))
//     fmt::print("{} [{}]: {}\n", key.path, key.unit, key.doc);
//
// The list is made from the field tables (*.fields.h), with which files are read as well.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/units/each_field.h"

namespace sinew::files {

using KeyType = units::FieldType;

// Key in a file of one kind.
struct Key {
  std::string kind;  // kind of file: "robot"; "any" for keys of all kinds
  std::string path;  // "joint.<name>.damping", "fault[].at": <name> is chosen by the user
  KeyType type = KeyType::text;
  std::string unit;                // SI, of numbers; empty for the others
  std::string per;                 // polynomial: c0 is in `unit`, c1 in `unit` per this
  double min = -units::unbounded;  // limits of the field, in `unit`
  double max = units::unbounded;
  double least = 0;                  // smallest magnitude other than 0
  double most = units::unbounded;    // largest magnitude of quantities with this unit
  std::string why;                   // reason for the limits
  bool required = false;             // whether its table must have it
  std::string default_text;          // default, as it would be written
  std::vector<std::string> choices;  // words
  std::string when;                  // `kind = "tension"`: condition for this row; empty: always
  std::string doc;                   // description in one line
};

// Returns the kinds of files in the order of the documentation, "any" last.
const std::vector<std::string>& key_kinds();

// Return the keys of all kinds of files, or of one, in the order of their tables. A key that
// depends on a choice, such as a sensor's scale, has a row for each variant. Throw config::Error
// for an unknown kind.
const std::vector<Key>& keys();
std::vector<Key> keys_of(std::string_view kind);

// Returns the kinds whose keys a file of that kind may contain, its own first: an experiment may
// change any key of its robot.
std::vector<std::string> kinds_within(std::string_view kind);

// Returns whether the path is that key, with any name for <name> and an index in [].
bool is_key(const Key& key, std::string_view path);

// Returns the SI unit of a number with this key in a file of a machine, also of a table that a file
// lacks: "s" for plant_steps.body. Empty for keys without a unit, unknown ones, and those whose
// unit depends on another value.
std::string unit_of(std::string_view path);

// Returns the keys that have all words in their path, description or choices, ignoring case. A word
// with a dot is a key or the beginning of one: joint.hip.damping. An empty `kind` means all. Throws
// config::Error with the nearest key if no key matches.
std::vector<Key> find_keys(const std::vector<std::string>& words, std::string_view kind = "");

// Returns the range as in the reader's messages, "0 m to 10 m"; empty if the key has no range.
std::string range_of(const Key& key);

// Returns the name of a type in json_of(), "number".
std::string_view to_text(KeyType type);

}  // namespace sinew::files
