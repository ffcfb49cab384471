// tests/field_visitor.h - the smallest visitor of units/field.h, for tests of field tables.
//
// It holds the values as SI under "group.key", sets the fields from them, and records which fields
// were read. Folders test their tables with it without config/, which they may not include.
#pragma once

#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "sinew/units/field.h"

namespace sinew::tests {

struct FieldVisitor {
  // Given by the test: numbers in SI, words of choices, texts.
  std::map<std::string, std::vector<double>> numbers_given;
  std::map<std::string, std::string> words_given;

  // The fields that the table read, in its order, and the errors that it reported.
  struct Asked {
    std::string key, unit, doc;
    bool optional = false;
    double min = 0, max = 0;
  };
  std::vector<Asked> asked;
  std::vector<std::string> complaints;

  const Asked* find(std::string_view key) const {
    for (const auto& a : asked) {
      if (a.key == key) return &a;
    }
    return nullptr;
  }

  using Field = units::Field;

  void number(const Field& field, double& value) {
    if (const auto* given = ask(field)) value = given->front();
  }
  void numbers(const Field& field, std::vector<double>& values) {
    if (const auto* given = ask(field)) values = *given;
  }
  void polynomial(const Field& field, std::vector<double>& values, std::string_view) {
    if (const auto* given = ask(field)) values = *given;
  }
  void flag(const Field& field, bool& value) {
    if (const auto* given = ask(field)) value = given->front() != 0;
  }
  void text(const Field& field, std::string& value) {
    ask(field);
    if (const auto word = words_given.find(path_of(field)); word != words_given.end())
      value = word->second;
  }
  template <class Enum>
  void choice(const Field& field, Enum& value,
              std::initializer_list<units::Choice<std::type_identity_t<Enum>>> choices) {
    ask(field);
    const auto word = words_given.find(path_of(field));
    if (word == words_given.end()) return;
    for (const auto& c : choices) {
      if (c.word == word->second) value = c.value;
    }
  }
  template <class Visit>
  void group(const Field& field, Visit visit) {
    ask(field);
    const std::string outer = prefix_;
    prefix_ = path_of(field) + ".";
    visit(*this);
    prefix_ = outer;
  }
  template <class T, class Visit>
  void each(const Field& field, std::vector<T>& items, Visit visit) {
    ask(field);
    const std::string outer = prefix_;
    for (T& item : items) {
      prefix_ = outer + std::string(field.name) + "." + item.name + ".";
      visit(*this, item);
    }
    prefix_ = outer;
  }
  void report_conflict(std::string_view key, std::string, std::string, std::string) {
    complaints.push_back(prefix_ + std::string(key));
  }

 private:
  std::string path_of(const Field& field) const { return prefix_ + std::string(field.name); }

  const std::vector<double>* ask(const Field& field) {
    asked.push_back({path_of(field), std::string(field.unit), std::string(field.doc),
                     field.optional, field.min, field.max});
    const auto given = numbers_given.find(path_of(field));
    return given == numbers_given.end() ? nullptr : &given->second;
  }

  std::string prefix_;
};

}  // namespace sinew::tests
