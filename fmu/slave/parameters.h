// fmu/slave/parameters.h - conversion of structs with field tables (units/field.h) to a flat
// list of parameters and back.
//
//   Lister list("actuator.");
//   actuator::fields(list, a);            // list.found: actuator.braid.turns, …
//   Filler fill(list.found, "actuator.");
//   actuator::fields(fill, b);            // b == a
//
// An importer thus sees the keys of Sinew's files with their units, ranges and descriptions, and
// its values are processed like a file's values. Numbers are as in the struct: SI, without
// conversion between gauge and absolute pressures.
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "fmu/slave/description.h"
#include "sinew/units/field.h"

namespace sinew::fmu {

// Value of a struct with its key.
struct Parameter {
  // word: a choice, a flag or a text, which is not a variable of an FMU.
  enum class Kind { number, integer, word };
  std::string name;  // "actuator.effectiveness.polynomial[1]"
  Kind kind = Kind::number;
  std::string unit;
  double min = -units::unbounded, max = units::unbounded;
  std::string doc;
  double number = 0;
  std::string word;
};

// Visitor that lists parameters. Unset values (not finite, an empty text) are left out.
class Lister {
 public:
  using Field = units::Field;
  // Adds `prefix` to all names.
  explicit Lister(std::string prefix) : prefix_(std::move(prefix)) {}

  std::vector<Parameter> found;

  // Functions of a visitor, see units/field.h.
  void number(const Field& f, double& value) { add(f, std::string(f.name), f.unit, value); }
  void numbers(const Field& f, std::vector<double>& values) {
    for (std::size_t k = 0; k < values.size(); ++k) add(f, element(f, k), f.unit, values[k]);
  }
  void polynomial(const Field& f, std::vector<double>& values, std::string_view per) {
    for (std::size_t k = 0; k < values.size(); ++k) {
      std::string unit = k == 0 ? std::string(f.unit) : "1/" + std::string(per);
      if (k > 1) unit += std::to_string(k);
      add(f, element(f, k), unit, values[k]);
    }
  }
  void integer(const Field& f, int& value) {
    add(f, std::string(f.name), "", value);
    found.back().kind = Parameter::Kind::integer;
  }
  void flag(const Field& f, bool& value) { word(f, value ? "true" : "false"); }
  void text(const Field& f, std::string& value) {
    if (!value.empty()) word(f, value);
  }
  template <class Enum>
  void choice(const Field& f, Enum& value,
              std::initializer_list<units::Choice<std::type_identity_t<Enum>>> choices) {
    for (const auto& c : choices)
      if (c.value == value) word(f, std::string(c.word));
  }
  template <class Inside>
  void group(const Field& f, const Inside& inside) {
    const std::string outer = prefix_;
    prefix_ += std::string(f.name) + ".";
    inside(*this);
    prefix_ = outer;
  }

 private:
  static std::string element(const Field& f, std::size_t k) {
    return std::string(f.name) + "[" + std::to_string(k) + "]";
  }
  void add(const Field& f, const std::string& name, std::string_view unit, double value) {
    if (!std::isfinite(value)) return;
    found.push_back({.name = prefix_ + name,
                     .unit = std::string(unit),
                     .min = f.min,
                     .max = f.max,
                     .doc = std::string(f.doc),
                     .number = value});
  }
  void word(const Field& f, std::string value) {
    found.push_back({.name = prefix_ + std::string(f.name),
                     .kind = Parameter::Kind::word,
                     .doc = std::string(f.doc),
                     .word = std::move(value)});
  }

  std::string prefix_;
};

// Visitor that fills a struct from such a list; a value that the list lacks keeps the struct's
// default. Throws std::runtime_error with the messages of the file's reader for values that
// contradict each other.
class Filler {
 public:
  using Field = units::Field;
  // Uses the parameters with `prefix` in the list, which must outlive this object.
  Filler(const std::vector<Parameter>& from, std::string prefix)
      : from_(from), prefix_(std::move(prefix)) {}

  // Functions of a visitor, see units/field.h.
  void number(const Field& f, double& value) {
    if (const Parameter* p = find(std::string(f.name))) value = p->number;
  }
  void numbers(const Field& f, std::vector<double>& values) {
    std::vector<double> read;
    for (;;) {
      const Parameter* p = find(std::string(f.name) + "[" + std::to_string(read.size()) + "]");
      if (!p) break;
      read.push_back(p->number);
    }
    if (!read.empty()) values = read;
  }
  void polynomial(const Field& f, std::vector<double>& values, std::string_view) {
    numbers(f, values);
  }
  void integer(const Field& f, int& value) {
    if (const Parameter* p = find(std::string(f.name))) value = static_cast<int>(p->number);
  }
  void flag(const Field& f, bool& value) {
    if (const Parameter* p = find(std::string(f.name))) value = p->word == "true";
  }
  void text(const Field& f, std::string& value) {
    if (const Parameter* p = find(std::string(f.name))) value = p->word;
  }
  template <class Enum>
  void choice(const Field& f, Enum& value,
              std::initializer_list<units::Choice<std::type_identity_t<Enum>>> choices) {
    const Parameter* p = find(std::string(f.name));
    if (!p) return;
    for (const auto& c : choices) {
      if (c.word != p->word) continue;
      value = c.value;
      return;
    }
    report_conflict(f.name, "\"" + p->word + "\"", "a word of this version", "");
  }
  template <class Inside>
  void group(const Field& f, const Inside& inside) {
    const std::string outer = prefix_;
    prefix_ += std::string(f.name) + ".";
    inside(*this);
    prefix_ = outer;
  }
  // Throws for values that contradict each other.
  [[noreturn]] void report_conflict(std::string_view key, const std::string& found,
                                    const std::string& expected, const std::string& try_this) {
    throw std::runtime_error(prefix_ + std::string(key) + ": found " + found + "; expected " +
                             expected + (try_this.empty() ? "" : "; try " + try_this));
  }

 private:
  const Parameter* find(const std::string& name) const {
    const std::string whole = prefix_ + name;
    for (const Parameter& p : from_)
      if (p.name == whole) return &p;
    return nullptr;
  }

  const std::vector<Parameter>& from_;
  std::string prefix_;
};

// Writes the list as lines of a description.
inline void write(const std::vector<Parameter>& list, Description& out) {
  for (const Parameter& p : list) {
    const bool word = p.kind == Parameter::Kind::word;
    out.add("value." + p.name, word ? "\"" + p.word + "\"" : text_of(p.number));
  }
}

// Returns these lines as a list with only names and values, which a Filler needs.
inline std::vector<Parameter> parameters_of(const Description& description) {
  std::vector<Parameter> out;
  for (const auto& [key, value] : description.lines_of("value.")) {
    Parameter p{.name = key};
    if (value.size() >= 2 && value.front() == '"' && value.back() == '"')
      p.kind = Parameter::Kind::word, p.word = value.substr(1, value.size() - 2);
    else
      p.number = number_of(key, value);
    out.push_back(std::move(p));
  }
  return out;
}

}  // namespace sinew::fmu
