#include "sinew/config/node.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "sinew/units/quantity.h"

namespace sinew::config {

const Node* value_at(const Node& root, std::string_view path) {
  const Node* node = &root;
  while (node && !path.empty()) {
    const std::size_t end = std::min(path.find('.'), path.size());
    std::string_view segment = path.substr(0, end);
    path.remove_prefix(std::min(end + 1, path.size()));

    const std::size_t bracket = segment.find('[');
    node = node->find(segment.substr(0, bracket));
    if (!node || bracket == segment.npos) continue;
    std::size_t index = 0;
    std::from_chars(segment.data() + bracket + 1, segment.data() + segment.size(), index);
    node = index < node->children.size() ? &node->children[index] : nullptr;
  }
  return node;
}

namespace {

Node make(Node::Kind kind, std::string_view key, Location where) {
  Node node;
  node.kind = kind;
  node.key = key;
  node.where = std::move(where);
  return node;
}

// Returns the value itself of { value = …, source = … }.
const Node& value_of(const Node& node) {
  return node.is_value_table() ? *node.find("value") : node;
}
Node& value_of(Node& node) { return const_cast<Node&>(value_of(std::as_const(node))); }

// Keeps the replaced text for each item, as messages may suggest its unit.
void remember(Node& now, const Node& before) {
  if (before.is_table()) return;
  if (now.kind == Node::Kind::array && before.kind == Node::Kind::array && !before.children.empty())
    for (std::size_t i = 0; i < now.children.size(); ++i)
      remember(now.children[i], before.children[std::min(i, before.children.size() - 1)]);
  if (now.kind != Node::Kind::array && before.kind != Node::Kind::array)
    now.replaced = written(before);
}

}  // namespace

const Node* Node::find(std::string_view child_key) const {
  const auto it = std::find_if(children.begin(), children.end(),
                               [&](const Node& child) { return child.key == child_key; });
  return is_table() && it != children.end() ? &*it : nullptr;
}

Node* Node::find(std::string_view child_key) {
  return const_cast<Node*>(std::as_const(*this).find(child_key));
}

Node& Node::put(Node child) {
  if (Node* there = find(child.key)) {
    remember(value_of(child), value_of(*there));
    return *there = std::move(child);
  }
  return children.emplace_back(std::move(child));
}

void Node::erase(std::string_view child_key) {
  std::erase_if(children, [&](const Node& child) { return child.key == child_key; });
}

Node make_text(std::string_view key, std::string text, Location where) {
  Node node = make(Node::Kind::text, key, std::move(where));
  node.text = std::move(text);
  return node;
}

Node make_table(std::string_view key, Location where) {
  return make(Node::Kind::table, key, std::move(where));
}

Node make_number(std::string_view key, double value, Location where) {
  Node node = make(Node::Kind::real, key, std::move(where));
  node.real = value;
  return node;
}

Node make_integer(std::string_view key, std::int64_t value, Location where) {
  Node node = make(Node::Kind::integer, key, std::move(where));
  node.integer = value;
  return node;
}

Node make_flag(std::string_view key, bool value, Location where) {
  Node node = make(Node::Kind::flag, key, std::move(where));
  node.flag = value;
  return node;
}

std::string shown(const Node& node) {
  if (node.kind == Node::Kind::text) return in_quotes(node.text);
  const bool holds_others = node.kind == Node::Kind::table || node.kind == Node::Kind::array;
  return holds_others ? std::string(kind_name(node.kind)) : written(node);
}

std::string written(const Node& node) {
  switch (node.kind) {
    case Node::Kind::text:
      return node.text;
    case Node::Kind::integer:
      return std::to_string(node.integer);
    case Node::Kind::real:
      return units::format_number(node.real);
    case Node::Kind::flag:
      return node.flag ? "true" : "false";
    default:
      break;
  }
  std::string text;
  for (const Node& child : node.children) text += (text.empty() ? "" : ", ") + written(child);
  return text;
}

std::string_view kind_name(Node::Kind kind) {
  constexpr std::string_view words[] = {"a table",        "a list",   "text",
                                        "a whole number", "a number", "true or false"};
  return words[static_cast<std::size_t>(kind)];
}

void merge(Node& base, const Node& over) {
  for (const Node& child : over.children) {
    Node* there = base.find(child.key);
    const bool both_tables = there && there->is_table() && child.is_table();
    const bool is_another_valve = child.is_table() && child.find("catalogue");
    if (both_tables && !there->is_value_table() && !child.is_value_table() && !is_another_valve) {
      merge(*there, child);
    } else {
      base.put(child);
    }
  }
}

std::vector<std::string_view> keys_of(const Node& table) {
  std::vector<std::string_view> keys;
  for (const Node& child : table.children) keys.push_back(child.key);
  return keys;
}

}  // namespace sinew::config
