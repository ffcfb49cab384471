// units/each_field.h - visitor that calls a function with each field of a table, its path and its
// value, which the function may change.
//
//   units::EachField visitor([](units::VisitedField& f) { fmt::print("{}\n", f.path); });
//   fields(visitor, robot);
//
// All uses of field tables but reading are such functions: the writer of files, the list of keys,
// the parameters of an FMU, the numbers that a fit may change.
#pragma once

#include <cstddef>
#include <functional>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "sinew/units/field.h"

namespace sinew::units {

// Type of a key's value.
enum class FieldType {
  number,      // a quantity, "3.2 in"
  numbers,     // a list of quantities
  polynomial,  // a list: c0, c1, … each with its own unit
  whole,       // a whole number
  flag,        // true or false
  text,
  texts,   // a list of texts
  choice,  // one of some words
  table,   // a table of keys
  tables,  // a table of named tables
  list,    // [[…]]: a list of tables
  item,    // one of the tables in the last two
};

// Visited field with its value in SI: the member of its type is set, those of tables have none.
struct VisitedField {
  const Field& field;
  FieldType type;
  std::string_view path = "";  // "joint.hip.damping", "fault[0].at"; valid during the call
  std::string_view name = "";  // last part of the path; empty: an item of a list
  std::size_t depth = 0;       // number of tables around it

  double* number = nullptr;
  std::vector<double>* numbers = nullptr;  // also the coefficients of a polynomial
  int* whole = nullptr;
  bool* flag = nullptr;
  std::string* text = nullptr;
  std::vector<std::string>* texts = nullptr;
  std::string_view per = "";                 // unit of a polynomial's argument
  std::vector<std::string_view> words = {};  // words of a choice
  std::size_t choice = 0;                    // index in `words`; their number: none of them
};

class EachField {
 public:
  // Tables whose fields are visited: those that the struct has, or one pattern of each, "<name>"
  // and "[]".
  enum class Items { own, pattern };
  using Function = std::function<void(VisitedField&)>;
  using Conflict = std::function<void(const std::string& path, const std::string& found,
                                      const std::string& expected, const std::string& try_this)>;

  // Calls `function` with each field; paths begin with `prefix`.
  explicit EachField(Function function, Items items = Items::own, std::string prefix = "")
      : function_(std::move(function)), items_(items), prefix_(std::move(prefix)) {}

  // Calls `conflict` for keys that exclude each other, which are ignored otherwise.
  void on_conflict(Conflict conflict) { conflict_ = std::move(conflict); }

  // Functions of a visitor, see units/field.h.
  void number(const Field& f, double& v) {
    call({.field = f, .type = FieldType::number, .number = &v});
  }
  void numbers(const Field& f, std::vector<double>& v) {
    call({.field = f, .type = FieldType::numbers, .numbers = &v});
  }
  void polynomial(const Field& f, std::vector<double>& v, std::string_view per) {
    call({.field = f, .type = FieldType::polynomial, .numbers = &v, .per = per});
  }
  void integer(const Field& f, int& v) {
    call({.field = f, .type = FieldType::whole, .whole = &v});
  }
  void flag(const Field& f, bool& v) { call({.field = f, .type = FieldType::flag, .flag = &v}); }
  void text(const Field& f, std::string& v) {
    call({.field = f, .type = FieldType::text, .text = &v});
  }
  void texts(const Field& f, std::vector<std::string>& v) {
    call({.field = f, .type = FieldType::texts, .texts = &v});
  }
  void named_numbers(const Field& f, std::map<std::string, double>& values) {
    group(f, [&](EachField& v) {
      Field one = f;
      std::map<std::string, double> pattern{{"<name>", 0}};
      for (auto& [name, value] : items_ == Items::own ? values : pattern) {
        one.name = name;
        v.number(one, value);
      }
    });
  }
  template <class Enum>
  void choice(const Field& f, Enum& value,
              std::initializer_list<Choice<std::type_identity_t<Enum>>> choices) {
    VisitedField visited{.field = f, .type = FieldType::choice};
    visited.choice = choices.size();
    for (const auto& choice : choices) {
      if (choice.value == value) visited.choice = visited.words.size();
      visited.words.push_back(choice.word);
    }
    call(visited);
    if (visited.choice < choices.size()) value = choices.begin()[visited.choice].value;
  }
  template <class Visit>
  void group(const Field& f, Visit visit) {
    inside(f, FieldType::table, f.name, [&] { visit(*this); });
  }
  template <class T, class Visit>
  void each(const Field& f, std::vector<T>& items, Visit visit) {
    std::vector<T> pattern;
    if (items_ == Items::pattern) pattern.emplace_back().name = "<name>";
    inside(f, FieldType::tables, f.name, [&] {
      for (T& item : items_ == Items::own ? items : pattern)
        inside(f, FieldType::item, item.name, [&] { visit(*this, item); });
    });
  }
  template <class T, class Visit>
  void list(const Field& f, std::vector<T>& items, Visit visit) {
    std::vector<T> pattern;
    if (items_ == Items::pattern) pattern.emplace_back();
    inside(f, FieldType::list, f.name, [&] {
      const std::size_t end = prefix_.size() - 1;  // without the dot
      std::size_t i = 0;
      for (T& item : items_ == Items::own ? items : pattern) {
        prefix_.resize(end);
        prefix_ += "[" + (items_ == Items::own ? std::to_string(i++) : "") + "]";
        inside(f, FieldType::item, "", [&] { visit(*this, item); });
      }
    });
  }
  void report_conflict(std::string_view key, const std::string& found, const std::string& expected,
                       const std::string& try_this) const {
    if (conflict_) conflict_(prefix_ + std::string(key), found, expected, try_this);
  }

 private:
  void call(VisitedField&& visited) { call(visited); }
  void call(VisitedField& visited) {
    visited.name = visited.field.name;
    visited.path = path_of(visited.name);
    visited.depth = depth_;
    function_(visited);
  }

  std::string_view path_of(std::string_view name) { return path_.assign(prefix_).append(name); }

  // Calls the function with a table, and visits its fields.
  template <class Visit>
  void inside(const Field& f, FieldType type, std::string_view name, const Visit& visit) {
    VisitedField visited{.field = f, .type = type};
    visited.path = path_of(name);
    visited.name = name;
    visited.depth = depth_;
    function_(visited);
    const std::size_t outer = prefix_.size();
    prefix_.append(name).append(".");
    ++depth_;
    visit();
    --depth_;
    prefix_.resize(outer);
  }

  Function function_;
  Items items_;
  std::string prefix_;  // path of the visited table, with a dot
  std::string path_;    // path to the visited field
  std::size_t depth_ = 0;
  Conflict conflict_;
};

}  // namespace sinew::units
