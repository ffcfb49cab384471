#include "sinew/config/write/writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/config/changes.h"
#include "sinew/config/quantity.h"
#include "sinew/config/utf8.h"

namespace sinew::config {

namespace {

// --- a tree as TOML ---

bool is_bare(std::string_view key) {
  const auto plain = [](unsigned char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
           c == '-';
  };
  return !key.empty() && std::all_of(key.begin(), key.end(), plain);
}

std::string toml_key(std::string_view key) {
  return is_bare(key) ? std::string(key) : toml_string(key);
}

std::string toml_real(double value) {
  const std::string text = format_number(value);
  return text.find_first_of(".en") == text.npos ? text + ".0" : text;
}

std::string inline_value(const Node& node) {
  switch (node.kind) {
    case Node::Kind::text:
      return toml_string(node.text);
    case Node::Kind::real:
      return toml_real(node.real);
    case Node::Kind::integer:
      return std::to_string(node.integer);
    case Node::Kind::flag:
      return node.flag ? "true" : "false";
    default:
      break;
  }
  const bool table = node.is_table();
  std::string inside;
  for (const Node& child : node.children) {
    if (!inside.empty()) inside += ", ";
    if (table) inside += toml_key(child.key) + " = ";
    inside += inline_value(child);
  }
  return table ? fmt::format("{{ {} }}", inside) : fmt::format("[{}]", inside);
}

bool has_header(const Node& node) { return node.is_table() && !node.is_value_table(); }

bool is_list_of_tables(const Node& node) {
  return node.kind == Node::Kind::array && !node.children.empty() &&
         std::all_of(node.children.begin(), node.children.end(),
                     [](const Node& item) { return item.is_table(); });
}

void print_table(const Node& table, const std::string& path, std::string& out) {
  for (const Node& child : table.children) {
    if (has_header(child) || is_list_of_tables(child)) continue;
    out += fmt::format("{} = {}\n", toml_key(child.key), inline_value(child));
  }
  for (const Node& child : table.children) {
    const std::string child_path = path + (path.empty() ? "" : ".") + toml_key(child.key);
    if (is_list_of_tables(child)) {
      for (const Node& item : child.children) {
        out += fmt::format("\n[[{}]]\n", child_path);
        print_table(item, child_path, out);
      }
    } else if (has_header(child)) {
      // A table of tables needs no header of its own.
      const bool only_tables =
          !child.children.empty() &&
          std::all_of(child.children.begin(), child.children.end(), has_header);
      if (!only_tables) out += fmt::format("\n[{}]\n", child_path);
      print_table(child, child_path, out);
    }
  }
}

// --- values and their provenance ---

// `plain`: in SI with all digits; else without digits caused by conversion.
Node quantity_node(std::string_view key, double si, std::string_view unit, bool plain) {
  if (plain) return unit == "1" ? make_number(key, si) : make_text(key, format_quantity(si, unit));
  std::string text = short_quantity(si, unit);
  return unit == "1" && !text.ends_with('%') ? make_number(key, si)
                                             : make_text(key, std::move(text));
}

Node make_array(std::string_view key) {
  Node node;
  node.kind = Node::Kind::array;
  node.key = key;
  return node;
}

// Returns { value = …, source = … }, or the bare value if it has no provenance.
Node with_origin(Node value, const Origin& origin) {
  Node table = make_table(value.key);
  value.key = "value";
  table.put(std::move(value));
  if (origin.is_default) {
    table.put(make_text("source", "default"));
  } else if (!origin.source.empty()) {
    table.put(make_text("source", origin.source));
  }
  if (origin.fit) table.put(make_flag("fit", true));
  if (origin.guess) table.put(make_flag("guess", true));
  if (!origin.range.empty()) {
    Node& range = table.put(make_array("range"));
    for (const auto& end : origin.range) range.children.push_back(make_text("", end));
  }
  if (!origin.uncertainty.empty()) table.put(make_text("uncertainty", origin.uncertainty));
  if (table.children.size() > 1) return table;
  Node bare = std::move(table.children.front());
  bare.key = table.key;
  return bare;
}

}  // namespace

std::string toml_string(std::string_view text) {
  std::string out = "\"";
  for (const char c : in_utf8(text)) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (byte < 0x20 || byte == 0x7F) {
      out += fmt::format("\\u{:04X}", byte);
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string to_toml(const Node& root) {
  std::string out;
  print_table(root, "", out);
  return out;
}

void Writer::format(std::string_view kind) { add(make_text("format", newest_format(kind))); }

void Writer::number(const Field& field, double& value) {
  if (std::isfinite(value)) add(quantity_node(field.name, value, field.unit, !origins_));
}

void Writer::numbers(const Field& field, std::vector<double>& values) {
  Node list = make_array(field.name);
  for (double v : values) list.children.push_back(quantity_node("", v, field.unit, !origins_));
  add(std::move(list));
}

void Writer::polynomial(const Field& field, std::vector<double>& coefficients,
                        std::string_view per) {
  if (coefficients.empty()) return;
  Node list = make_array(field.name);
  for (std::size_t k = 0; k < coefficients.size(); ++k) {
    const std::string unit = coefficient_unit(field.unit, per, static_cast<int>(k));
    list.children.push_back(quantity_node("", coefficients[k], unit, !origins_));
  }
  add(std::move(list));
}

void Writer::integer(const Field& field, int& value) { add(make_integer(field.name, value)); }

void Writer::flag(const Field& field, bool& value) { add(make_flag(field.name, value)); }

void Writer::text(const Field& field, std::string& value) { add(make_text(field.name, value)); }

void Writer::texts(const Field& field, std::vector<std::string>& values) {
  Node list = make_array(field.name);
  for (const std::string& v : values) list.children.push_back(make_text("", v));
  add(std::move(list));
}

void Writer::named_numbers(const Field& field, std::map<std::string, double>& values) {
  enter(field.name, Node::Kind::table);
  for (const auto& [name, value] : values) {
    if (std::isfinite(value)) add(quantity_node(name, value, field.unit, !origins_));
  }
  leave();
}

std::string Writer::text() const { return to_toml(root()); }

void Writer::enter(std::string_view key, Node::Kind kind) {
  const Node* there = open_.back().find(key);
  Node node = there && there->kind == kind ? *there : make_table(key);
  node.kind = kind;
  open_.push_back(std::move(node));
}

void Writer::leave() {
  Node done = std::move(open_.back());
  open_.pop_back();
  if (open_.back().kind == Node::Kind::array) {
    open_.back().children.push_back(std::move(done));
  } else {
    open_.back().put(std::move(done));
  }
}

void Writer::add(Node value) {
  const Origin* origin = origins_ ? find_origin(*origins_, path_of(value.key)) : nullptr;
  open_.back().put(origin ? with_origin(std::move(value), *origin) : std::move(value));
}

std::string Writer::path_of(std::string_view key) const {
  std::string path;
  for (std::size_t i = 1; i < open_.size(); ++i) {
    const Node& node = open_[i];
    if (!node.key.empty()) {
      path += (path.empty() ? "" : ".") + node.key;
    } else {
      path += fmt::format("[{}]", open_[i - 1].children.size());
    }
  }
  return path + (path.empty() ? "" : ".") + std::string(key);
}

}  // namespace sinew::config
