// files/key_lister.h - the visitor of units/field.h that notes which fields there are.
//
// Which fields a table has, and with which unit, can follow from the words beside them. So a lister
// can be told what to find at a place, and another one sees another table.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "sinew/config/quantity.h"
#include "sinew/files/keys.h"
#include "sinew/units/field.h"
#include "sinew/units/ranges.h"

namespace sinew::files {

// What a lister finds at places: a word of a choice, a text, a number.
using Found = std::map<std::string, std::string>;

class KeyLister {
 public:
  using Field = units::Field;

  // `kind` is that of the keys that it lists.
  KeyLister(std::string_view kind, Found found) : kind_(kind), found_(std::move(found)) {}

  // What was visited, in its order.
  std::vector<Key> keys;

  // The functions of a visitor, units/field.h.
  void number(const Field& f, double& value) {
    quantity(f, KeyType::number, text_of(f, value));
    if (const auto at = found_.find(keys.back().path); at != found_.end())
      value = std::stod(at->second);
  }
  void numbers(const Field& f, std::vector<double>& values) {
    quantity(f, KeyType::numbers, joined(f, values));
  }
  void polynomial(const Field& f, std::vector<double>&, std::string_view per) {
    // Their ends are those of their units alone.
    Key& key = add(f, KeyType::polynomial);
    key.unit = f.unit;
    key.per = per;
  }
  void integer(const Field& f, int& value) {
    Key& key = add(f, KeyType::whole);
    key.min = f.min;
    key.max = f.max;
    default_is(key, std::to_string(value));
  }
  void flag(const Field& f, bool& value) {
    default_is(add(f, KeyType::flag), value ? "true" : "false");
  }
  void text(const Field& f, std::string& value) {
    Key& key = add(f, KeyType::text);
    default_is(key, value);
    if (const auto at = found_.find(key.path); at != found_.end()) value = at->second;
  }
  void texts(const Field& f, std::vector<std::string>& values) {
    std::string all;
    for (const std::string& one : values) all += (all.empty() ? "" : ", ") + one;
    default_is(add(f, KeyType::texts), all);
  }
  void named_numbers(const Field& f, std::map<std::string, double>&) {
    group(f, [&](KeyLister& v) {
      Field one = f;
      one.name = "<name>";
      double value = 0;
      v.number(one, value);
    });
  }
  template <class Enum>
  void choice(const Field& f, Enum& value,
              std::initializer_list<units::Choice<std::type_identity_t<Enum>>> choices) {
    Key& key = add(f, KeyType::choice);
    for (const auto& choice : choices) {
      key.choices.emplace_back(choice.word);
      if (choice.value == value) default_is(key, std::string(choice.word));
    }
    const auto at = found_.find(key.path);
    if (at == found_.end()) return;
    for (const auto& choice : choices)
      if (choice.word == at->second) value = choice.value;
  }
  template <class Visit>
  void group(const Field& f, Visit visit) {
    add(f, KeyType::table);
    inside(std::string(f.name), [&] { visit(*this); });
  }
  template <class T, class Visit>
  void each(const Field& f, std::vector<T>&, Visit visit) {
    add(f, KeyType::tables);
    T item{};
    item.name = "<name>";
    inside(std::string(f.name) + ".<name>", [&] { visit(*this, item); });
  }
  template <class T, class Visit>
  void list(const Field& f, std::vector<T>&, Visit visit) {
    add(f, KeyType::list);
    T item{};
    inside(std::string(f.name) + "[]", [&] { visit(*this, item); });
  }

 private:
  static std::string text_of(const Field& f, double value) {
    return std::isfinite(value) ? config::format_quantity(value, f.unit) : "not set";
  }
  static std::string joined(const Field& f, const std::vector<double>& values) {
    std::string all;
    for (const double value : values) all += (all.empty() ? "" : ", ") + text_of(f, value);
    return all;
  }
  static void default_is(Key& key, std::string text) {
    if (!key.required) key.default_text = std::move(text);
  }

  Key& add(const Field& f, KeyType type) {
    keys.push_back({.kind = kind_,
                    .path = prefix_ + std::string(f.name),
                    .type = type,
                    .required = !f.optional,
                    .doc = std::string(f.doc)});
    return keys.back();
  }
  void quantity(const Field& f, KeyType type, std::string default_text) {
    Key& key = add(f, type);
    key.unit = f.unit;
    key.min = f.min;
    key.max = f.max;
    key.least = f.least;
    key.most = units::range_of(f.unit).most;
    key.why = f.why;
    default_is(key, std::move(default_text));
  }
  template <class Visit>
  void inside(const std::string& name, const Visit& visit) {
    const std::string outer = prefix_;
    prefix_ += name + ".";
    visit();
    prefix_ = outer;
  }

  std::string kind_;
  Found found_;
  std::string prefix_;
};

}  // namespace sinew::files
