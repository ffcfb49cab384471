// config/node.h - tree of a TOML file, independent of the TOML library, which only toml_file.cpp
// uses.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/config/diagnostics.h"

namespace sinew::config {

struct Node {
  // Kind of the value.
  enum class Kind { table, array, text, integer, real, flag };

  Kind kind = Kind::table;
  std::string key;  // empty at the root and in arrays
  Location where;   // place of the key; in arrays, of the value

  // Value; only the member of `kind` is used.
  std::string text;
  std::int64_t integer = 0;
  double real = 0;
  bool flag = false;
  std::vector<Node> children;  // children of tables and arrays, in order of appearance
  std::string replaced;        // text of a previous value that put() replaced

  mutable bool used = false;  // read by a reader; an unused key is an unknown one

  // Return whether it is a table, and whether it is a number of either kind.
  bool is_table() const { return kind == Kind::table; }
  bool is_number() const { return kind == Kind::integer || kind == Kind::real; }
  // Returns whether it has the form { value = …, source = … }.
  bool is_value_table() const { return is_table() && find("value") != nullptr; }

  // Returns the child with that key; nullptr if it does not exist.
  const Node* find(std::string_view child_key) const;
  Node* find(std::string_view child_key);
  // Adds the child, or replaces the one with its key.
  Node& put(Node child);
  void erase(std::string_view child_key);
};

// Each makes a node of that kind with the key; `where` is its place in messages.
Node make_text(std::string_view key, std::string text, Location where = {});
Node make_table(std::string_view key, Location where = {});
Node make_number(std::string_view key, double value, Location where = {});
Node make_integer(std::string_view key, std::int64_t value, Location where = {});
Node make_flag(std::string_view key, bool value, Location where = {});

// Returns a value for messages: "3.15 in" in quotes, 3.15, true, "a table".
std::string shown(const Node& node);
// Returns a value as written, without quotes; elements of arrays are joined by ", ".
std::string written(const Node& node);
// Returns the name of a kind: "a table", "text", "a whole number" ...
std::string_view kind_name(Node::Kind kind);

// Merges tables key by key, where `over` takes precedence; any other value, a value with its
// source, and a valve for which `over` names one of a catalogue, is replaced as a whole.
void merge(Node& base, const Node& over);

// Returns the names of a table's children, for suggestions.
std::vector<std::string_view> keys_of(const Node& table);

// Parse a file or a text; throw Error if the file cannot be read or is not TOML.
Node parse_file(const std::string& path);
Node parse_text(std::string_view text, const std::string& name);

// Lookup of a value by its key as written in origins.

// Returns the value at "reported[0].accept" or "joint.hip.damping"; nullptr if it does not exist.
const Node* value_at(const Node& root, std::string_view path);

}  // namespace sinew::config
