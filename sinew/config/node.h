// config/node.h - our own tree of a file, so that toml_file.cpp alone knows the TOML library.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/config/diagnostics.h"

namespace sinew::config {

struct Node {
  // Names what stands there.
  enum class Kind { table, array, text, integer, real, flag };

  Kind kind = Kind::table;
  std::string key;  // empty at the root and in arrays
  Location where;   // of the key; of the value in arrays

  // What the kind says; the others stay as they are.
  std::string text;
  std::int64_t integer = 0;
  double real = 0;
  bool flag = false;
  std::vector<Node> children;  // of tables and arrays, in order of appearance
  std::string replaced;        // what was written in its place, where put() took that away

  mutable bool used = false;  // somebody asked for it; what stays unused is an unknown key

  // Is it a table, or a number of either kind?
  bool is_table() const { return kind == Kind::table; }
  bool is_number() const { return kind == Kind::integer || kind == Kind::real; }
  // { value = …, source = … }
  bool is_value_table() const { return is_table() && find("value") != nullptr; }

  // Returns the child of that key; nullptr where there is none.
  const Node* find(std::string_view child_key) const;
  Node* find(std::string_view child_key);
  // Adds the child, or puts it in the place of the one with its key.
  Node& put(Node child);
  void erase(std::string_view child_key);
};

// Each makes a node of that kind, by the key; `where` is what messages point to.
Node make_text(std::string_view key, std::string text, Location where = {});
Node make_table(std::string_view key, Location where = {});
Node make_number(std::string_view key, double value, Location where = {});
Node make_integer(std::string_view key, std::int64_t value, Location where = {});
Node make_flag(std::string_view key, bool value, Location where = {});

// A value as a message shows it: "3.15 in" in quotes, 3.15, true, "a table".
std::string shown(const Node& node);
// A value as it was written, without quotes; arrays joined by ", ".
std::string written(const Node& node);
// "a table", "text", "a whole number" ...
std::string_view kind_name(Node::Kind kind);

// Tables are merged key by key and `over` wins; anything else, and a value with its source, is
// replaced as a whole.
void merge(Node& base, const Node& over);

// Names of a table's children, for suggestions.
std::vector<std::string_view> keys_of(const Node& table);

// Throw Error: the file cannot be read, or is not TOML.
Node parse_file(const std::string& path);
Node parse_text(std::string_view text, const std::string& name);

// A value of a tree by its key, as origins name it.

// Returns the value under "reported[0].accept" or "joint.hip.damping"; nullptr where the tree has
// none.
const Node* value_at(const Node& root, std::string_view path);

}  // namespace sinew::config
