#include "sinew/config/write/writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/config/changes.h"
#include "sinew/config/utf8.h"
#include "sinew/units/quantity.h"

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
  const std::string text = units::format_number(value);
  return text.find_first_of(".en") == text.npos ? text + ".0" : text;
}

std::string inline_value(const Node& node) {
  switch (node.kind) {
    case Node::Kind::text:
      return toml_string(node.text);
    case Node::Kind::real:
      return toml_real(node.real);
    case Node::Kind::integer:
    case Node::Kind::flag:
      return written(node);
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
  if (plain)
    return unit == "1" ? make_number(key, si) : make_text(key, units::format_quantity(si, unit));
  std::string text = units::short_quantity(si, unit);
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

void Writer::format(std::string_view kind) { root_.put(make_text("format", newest_format(kind))); }

std::string Writer::text() const { return to_toml(root()); }

void Writer::put(const units::VisitedField& f) {
  using Type = units::FieldType;
  open_.resize(f.depth + 1);
  if (f.type == Type::list) return enter(f, Node::Kind::array);
  if (f.type == Type::table || f.type == Type::tables || f.type == Type::item)
    return enter(f, Node::Kind::table);
  const bool unset = (f.type == Type::number && !std::isfinite(*f.number)) ||
                     (f.type == Type::polynomial && f.numbers->empty()) ||
                     (f.type == Type::choice && f.choice == f.words.size());
  if (unset) return;
  const Origin* origin = origins_ ? find_origin(*origins_, f.path) : nullptr;
  open_.back()->put(origin ? with_origin(value_of(f), *origin) : value_of(f));
}

// Opens a table; one that another struct has written is continued.
void Writer::enter(const units::VisitedField& f, Node::Kind kind) {
  Node& in = *open_.back();
  Node* there = in.find(f.name);
  if (!there || there->kind != kind) {
    Node node = make_table(f.name);
    node.kind = kind;
    there = in.is_table() ? &in.put(std::move(node)) : &in.children.emplace_back(std::move(node));
  }
  open_.push_back(there);
}

Node Writer::value_of(const units::VisitedField& f) const {
  using Type = units::FieldType;
  if (f.type == Type::number) return quantity_node(f.name, *f.number, f.field.unit, !origins_);
  if (f.type == Type::whole) return make_integer(f.name, *f.whole);
  if (f.type == Type::flag) return make_flag(f.name, *f.flag);
  if (f.type == Type::text) return make_text(f.name, *f.text);
  if (f.type == Type::choice) return make_text(f.name, std::string(f.words[f.choice]));
  Node list = make_array(f.name);
  if (f.type == Type::texts)
    for (const std::string& text : *f.texts) list.children.push_back(make_text("", text));
  else
    for (std::size_t k = 0; k < f.numbers->size(); ++k) {
      const std::string unit =
          f.type == Type::numbers
              ? std::string(f.field.unit)
              : units::coefficient_unit(f.field.unit, f.per, static_cast<int>(k));
      list.children.push_back(quantity_node("", (*f.numbers)[k], unit, !origins_));
    }
  return list;
}

}  // namespace sinew::config
