// tests/guards/numeric_fields.h - every number that a file of Sinew can hold, and a function that
// replaces it.
//
//   Lister lister;
//   experiment::run_fields(lister, e);         the visitor of units/field.h
//   for (const NumericField& f : lister.fields) put(root, f, config::make_number("", 0));
//
// The tree is that of a resolved file, in which every value is in SI.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

#include "sinew/config/compose.h"
#include "sinew/config/node.h"
#include "sinew/units/field.h"
#include "sinew/units/quantity.h"

namespace sinew::guards {

struct NumericField {
  enum class Kind { number, list, integer };

  std::string path;     // joint.hip.moment_arm
  std::string pattern;  // joint.*.moment_arm
  std::string unit;     // SI; empty of a whole number
  Kind kind = Kind::number;
  bool optional = false;
  std::vector<double> values;
};

class Lister {
 public:
  using Field = units::Field;

  std::vector<NumericField> fields;

  void number(const Field& f, double& x) { add(f, NumericField::Kind::number, {x}); }
  void numbers(const Field& f, std::vector<double>& x) { add(f, NumericField::Kind::list, x); }
  void polynomial(const Field& f, std::vector<double>& x, std::string_view) {
    add(f, NumericField::Kind::list, x);
  }
  void integer(const Field& f, int& x) {
    add(f, NumericField::Kind::integer, {static_cast<double>(x)});
  }
  void flag(const Field&, bool&) {}
  void text(const Field&, std::string&) {}
  void texts(const Field&, std::vector<std::string>&) {}
  void named_numbers(const Field& f, std::map<std::string, double>& values) {
    const Level level(*this, std::string(f.name), std::string(f.name));
    for (auto& [name, value] : values) {
      Field one = f;
      one.name = name;
      number(one, value);
    }
  }
  template <class Enum>
  void choice(const Field&, Enum&,
              std::initializer_list<units::Choice<std::type_identity_t<Enum>>>) {}
  template <class Visit>
  void group(const Field& f, Visit visit) {
    const Level level(*this, std::string(f.name), std::string(f.name));
    visit(*this);
  }
  template <class T, class Visit>
  void each(const Field& f, std::vector<T>& items, Visit visit) {
    const std::string name(f.name);
    for (T& item : items) {
      const Level level(*this, name + "." + item.name, name + ".*");
      visit(*this, item);
    }
  }
  template <class T, class Visit>
  void list(const Field& f, std::vector<T>& items, Visit visit) {
    const std::string name(f.name);
    for (std::size_t i = 0; i < items.size(); ++i) {
      const Level level(*this, name + "." + std::to_string(i), name + "[]");
      visit(*this, items[i]);
    }
  }

 private:
  // One table further in, until its end.
  struct Level {
    Level(Lister& to, const std::string& path, const std::string& pattern)
        : lister(to), path_size(to.path_.size()), pattern_size(to.pattern_.size()) {
      to.path_ += path + ".";
      to.pattern_ += pattern + ".";
    }
    ~Level() {
      lister.path_.resize(path_size);
      lister.pattern_.resize(pattern_size);
    }
    Lister& lister;
    std::size_t path_size, pattern_size;
  };

  void add(const Field& f, NumericField::Kind kind, std::vector<double> values) {
    const std::string name(f.name);
    fields.push_back(
        {path_ + name, pattern_ + name, std::string(f.unit), kind, f.optional, std::move(values)});
  }

  std::string path_, pattern_;
};

// The table that a path's last key belongs to; made where there is none.
inline config::Node& table_of(config::Node& root, const std::string& path, std::string& key) {
  config::Node* at = &root;
  std::size_t from = 0;
  for (std::size_t dot; (dot = path.find('.', from)) != path.npos; from = dot + 1) {
    const std::string name = path.substr(from, dot - from);
    if (at->kind == config::Node::Kind::array) {
      at = &at->children.at(std::stoul(name));
    } else {
      config::Node* child = at->find(name);
      at = child ? child : &at->put(config::make_table(name));
    }
  }
  key = path.substr(from);
  return *at;
}

// The value in the field's place, of a list in its first number's; at line 7 of cell.toml.
inline void put(config::Node& root, const NumericField& field, config::Node value) {
  const config::Location where{"cell.toml", 7, 1};
  std::string key;
  config::Node& table = table_of(root, field.path, key);
  value.where = where;
  if (field.kind == NumericField::Kind::list) {
    config::Node list;
    list.kind = config::Node::Kind::array;
    if (const config::Node* there = table.find(key))
      list = there->is_value_table() ? *there->find("value") : *there;
    value.key.clear();
    if (list.children.empty())
      list.children.push_back(std::move(value));
    else
      list.children.front() = std::move(value);
    value = std::move(list);
    value.where = where;
  }
  value.key = key;
  table.put(std::move(value));
}

// A number in the field's unit, as a file writes it.
inline config::Node quantity(const NumericField& field, double si) {
  if (field.unit.empty() && std::abs(si) < 1e15 && si == std::floor(si))
    return config::make_integer("", static_cast<std::int64_t>(si));
  if (field.unit.empty() || field.unit == "1") return config::make_number("", si);
  return config::make_text("", units::format_number(si) + " " + field.unit);
}

}  // namespace sinew::guards
