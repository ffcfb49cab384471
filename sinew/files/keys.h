// files/keys.h - every key that a TOML file of ours can have: what it holds, between which ends,
// what stands in its place where it is left out, and what it is for.
//
//   for (const files::Key& key : files::find_keys({"damping"}))
//     fmt::print("{} [{}]: {}\n", key.path, key.unit, key.doc);
//
// The field tables (*.fields.h) say all of it, the same ones from which files are read.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/units/field.h"

namespace sinew::files {

// What a key holds.
enum class KeyType {
  number,      // a quantity, "3.2 in"
  numbers,     // a list of quantities
  polynomial,  // a list: c0, c1, … each in a unit of its own
  whole,       // a whole number
  flag,        // true or false
  text,
  texts,   // a list of texts
  choice,  // one of the words in `choices`
  table,   // keys below it
  tables,  // a table for each name
  list,    // [[…]]: tables one after the other
};

// One key as a file of one kind can have it.
struct Key {
  std::string kind;  // of the file that it belongs to: "robot"; "any" for what all kinds have
  std::string path;  // "joint.<name>.damping", "fault[].at": <name> is yours
  KeyType type = KeyType::text;
  std::string unit;                // SI, of numbers; empty for the others
  std::string per;                 // polynomial: each next coefficient is in `unit` per this
  double min = -units::unbounded;  // the field's own ends, in `unit`
  double max = units::unbounded;
  double least = 0;                  // of what is not 0
  double most = units::unbounded;    // of the magnitude: no quantity of that unit is larger
  std::string why;                   // of these ends
  bool required = false;             // in its table, where that is there
  std::string default_text;          // what stands in its place, as it would be written
  std::vector<std::string> choices;  // words
  std::string when;                  // `kind = "tension"`: it is so only there; empty: always
  std::string doc;                   // one line
};

// Returns the kinds of files, in the order in which a newcomer meets them, "any" last.
const std::vector<std::string>& key_kinds();

// Returns the keys of all kinds of files, or of one, in the order of their tables. A key that is
// another one under another choice, as a sensor's scale, has a row for each. Throws config::Error
// for a kind that there is not.
const std::vector<Key>& keys();
std::vector<Key> keys_of(std::string_view kind);

// Returns the kinds whose keys a file of that kind can hold, its own first: an experiment may
// change anything of its robot.
std::vector<std::string> kinds_within(std::string_view kind);

// Is it that key, with a name of somebody in the place of <name>, and [0] in that of []?
bool is_key(const Key& key, std::string_view path);

// Returns the keys that have all of the words in their path, line or choices, in letters of either
// case. A word with a dot is a key or how one begins: joint.hip.damping. An empty `kind` is any.
// Throws config::Error where there is none, with the nearest.
std::vector<Key> find_keys(const std::vector<std::string>& words, std::string_view kind = "");

// Returns the range as the reader's messages say it, "0 m to 10 m"; empty where the key has none.
std::string range_of(const Key& key);

// Returns the name of a type as JSON has it, "number".
std::string_view to_text(KeyType type);

}  // namespace sinew::files
