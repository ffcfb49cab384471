// TOML text to our tree. The only file that knows the TOML library.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "sinew/config/node.h"
#include "sinew/config/text_file.h"

#define TOML_HEADER_ONLY 1
#define TOML_EXCEPTIONS 0
#include <toml++/toml.h>

namespace sinew::config {

namespace {

Location location(const toml::source_region& source, const std::string& file) {
  return {file, static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
}

bool before(const Node& a, const Node& b) {
  return std::pair(a.where.line, a.where.column) < std::pair(b.where.line, b.where.column);
}

Node node_from(const toml::node& value, std::string_view key, Location where);

// The library sorts keys by name; the order of the file tells a better story.
void add_table(Node& node, const toml::table& table) {
  for (const auto& [key, value] : table) {
    node.children.push_back(node_from(value, key.str(), location(key.source(), node.where.file)));
  }
  std::stable_sort(node.children.begin(), node.children.end(), before);
}

void add_array(Node& node, const toml::array& array) {
  for (const toml::node& value : array) {
    node.children.push_back(node_from(value, "", location(value.source(), node.where.file)));
  }
}

Node node_from(const toml::node& value, std::string_view key, Location where) {
  if (const auto* text = value.as_string()) return make_text(key, text->get(), where);
  if (const auto* whole = value.as_integer()) return make_integer(key, whole->get(), where);
  if (const auto* real = value.as_floating_point()) return make_number(key, real->get(), where);
  if (const auto* flag = value.as_boolean()) return make_flag(key, flag->get(), where);
  Node node = make_table(key, where);
  if (const auto* table = value.as_table()) {
    add_table(node, *table);
  } else if (const auto* array = value.as_array()) {
    node.kind = Node::Kind::array;
    add_array(node, *array);
  } else {
    fail(where, std::string(key), "a date or a time",
         "text, a number, true or false, a list or a table", "quotes around it");
  }
  return node;
}

std::string line_of(std::string_view text, int line) {
  std::istringstream lines{std::string(text)};
  std::string result;
  for (int i = 0; i < line; ++i) std::getline(lines, result);
  return result;
}

// The slip everybody makes: mount_length = 3.15 in
std::string syntax_hint(std::string_view line) {
  const std::size_t equals = line.find('=');
  if (equals == line.npos) return "";
  const std::size_t start = line.find_first_not_of(" \t", equals + 1);
  const bool bare = start != line.npos && (std::isdigit(static_cast<unsigned char>(line[start])) ||
                                           line[start] == '-' || line[start] == '+');
  if (!bare) return "";
  return "quotes around a quantity: " + std::string(line.substr(0, equals)) + "= \"3.15 in\"";
}

[[noreturn]] void fail_syntax(const toml::parse_error& error, std::string_view text,
                              const std::string& name) {
  const Location where = location(error.source(), name);
  fail(where, "", fmt::format("a syntax error: {}", error.description()), "TOML",
       syntax_hint(line_of(text, where.line)));
}

}  // namespace

Node parse_text(std::string_view text, const std::string& name) {
  const toml::parse_result result = toml::parse(text, name);
  if (!result) fail_syntax(result.error(), text, name);
  Node root = make_table("", {name, 1, 1});
  add_table(root, result.table());
  return root;
}

Node parse_file(const std::string& path) {
  return parse_text(read_text_file(path, "a TOML file"), path);
}

}  // namespace sinew::config
