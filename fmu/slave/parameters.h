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
#include <utility>
#include <vector>

#include "fmu/slave/description.h"
#include "sinew/units/each_field.h"

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
class Lister : public units::EachField {
 public:
  // Adds `prefix` to all names.
  explicit Lister(std::string prefix)
      : EachField([this](const units::VisitedField& f) { add(f); }, Items::own, std::move(prefix)) {
  }

  std::vector<Parameter> found;

 private:
  void add(const units::VisitedField& f) {
    if (f.number) add(f, "", f.field.unit, *f.number);
    for (std::size_t k = 0; f.numbers && k < f.numbers->size(); ++k) {
      const std::string power = k > 1 ? std::to_string(k) : "";
      const bool raised = f.type == units::FieldType::polynomial && k > 0;
      add(f, "[" + std::to_string(k) + "]",
          raised ? "1/" + std::string(f.per) + power : f.field.unit, (*f.numbers)[k]);
    }
    if (f.whole) {
      add(f, "", "", *f.whole);
      found.back().kind = Parameter::Kind::integer;
    }
    if (f.flag) add_word(f, *f.flag ? "true" : "false");
    if (f.text && !f.text->empty()) add_word(f, *f.text);
    if (f.choice < f.words.size()) add_word(f, std::string(f.words[f.choice]));
  }
  void add(const units::VisitedField& f, const std::string& element, std::string_view unit,
           double value) {
    if (!std::isfinite(value)) return;
    found.push_back({.name = std::string(f.path) + element,
                     .unit = std::string(unit),
                     .min = f.field.min,
                     .max = f.field.max,
                     .doc = std::string(f.field.doc),
                     .number = value});
  }
  void add_word(const units::VisitedField& f, std::string value) {
    found.push_back({.name = std::string(f.path),
                     .kind = Parameter::Kind::word,
                     .doc = std::string(f.field.doc),
                     .word = std::move(value)});
  }
};

// Visitor that fills a struct from such a list; a value that the list lacks keeps the struct's
// default. Throws std::runtime_error with the messages of the file's reader for values that
// contradict each other.
class Filler : public units::EachField {
 public:
  // Uses the parameters with `prefix` in the list, which must outlive this object.
  Filler(const std::vector<Parameter>& from, std::string prefix)
      : EachField([this](units::VisitedField& f) { fill(f); }, Items::own, std::move(prefix)),
        from_(from) {
    on_conflict(refuse);
  }

 private:
  [[noreturn]] static void refuse(const std::string& name, const std::string& found,
                                  const std::string& expected, const std::string& try_this) {
    throw std::runtime_error(name + ": found " + found + "; expected " + expected +
                             (try_this.empty() ? "" : "; try " + try_this));
  }

  void fill(units::VisitedField& f) const {
    if (f.numbers) return fill_numbers(f);
    const Parameter* p = find(f.path);
    if (!p) return;
    if (f.number) *f.number = p->number;
    if (f.whole) *f.whole = static_cast<int>(p->number);
    if (f.flag) *f.flag = p->word == "true";
    if (f.text) *f.text = p->word;
    if (f.type != units::FieldType::choice) return;
    for (f.choice = 0; f.choice < f.words.size(); ++f.choice)
      if (f.words[f.choice] == p->word) return;
    refuse(std::string(f.path), "\"" + p->word + "\"", "a word of this version", "");
  }
  void fill_numbers(const units::VisitedField& f) const {
    std::vector<double> read;
    while (const Parameter* p = find(std::string(f.path) + "[" + std::to_string(read.size()) + "]"))
      read.push_back(p->number);
    if (!read.empty()) *f.numbers = read;
  }
  const Parameter* find(std::string_view name) const {
    for (const Parameter& p : from_)
      if (p.name == name) return &p;
    return nullptr;
  }

  const std::vector<Parameter>& from_;
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
