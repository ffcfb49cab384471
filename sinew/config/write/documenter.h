// config/write/documenter.h - visitor that formats field tables as a Markdown table.
//
//   config::Documenter documenter;
//   Robot robot;
//   fields(documenter, robot);
//   docs << documenter.markdown();
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "sinew/units/field.h"

namespace sinew::config {

// Row of the table.
struct DocumentedField {
  std::string key;    // muscle.<name>.mount_length
  std::string unit;   // "m", "text", "whole number", "a or b"
  std::string range;  // "0 to 1 m"; empty: no range
  std::string doc;
  bool optional = false;
};

class Documenter {
 public:
  using Field = units::Field;

  // Functions of a visitor, see units/field.h.
  void number(const Field& field, double&) { add(field, field.unit); }
  void numbers(const Field& field, std::vector<double>&) {
    add(field, "list of " + std::string(field.unit));
  }
  void polynomial(const Field& field, std::vector<double>&, std::string_view per) {
    const std::string unit(field.unit);
    add(field, "list of " + unit + ", " + unit + " per " + std::string(per) + " …");
  }
  void integer(const Field& field, int&) { add(field, "whole number"); }
  void flag(const Field& field, bool&) { add(field, "true or false"); }
  void text(const Field& field, std::string&) { add(field, "text"); }
  void texts(const Field& field, std::vector<std::string>&) { add(field, "list of texts"); }
  void named_numbers(const Field& field, std::map<std::string, double>&) {
    add(field, "table of " + std::string(field.unit));
  }
  template <class Enum>
  void choice(const Field& field, Enum&,
              std::initializer_list<units::Choice<std::type_identity_t<Enum>>> choices) {
    std::vector<std::string_view> words;
    for (const auto& choice : choices) words.push_back(choice.word);
    add_choice(field, words);
  }
  template <class Visit>
  void group(const Field& field, Visit visit) {
    enter(field, "");
    visit(*this);
    path_.pop_back();
  }
  template <class T, class Visit>
  void each(const Field& field, std::vector<T>&, Visit visit) {
    enter(field, ".<name>");
    T item{};
    visit(*this, item);
    path_.pop_back();
  }
  template <class T, class Visit>
  void list(const Field& field, std::vector<T>&, Visit visit) {
    enter(field, "[]");
    T item{};
    visit(*this, item);
    path_.pop_back();
  }

  // Returns the visited keys, in their order.
  const std::vector<DocumentedField>& fields() const { return fields_; }
  std::string markdown() const;  // | key | unit | range | what it is |

 private:
  void add(const Field& field, std::string_view unit);
  void add_choice(const Field& field, const std::vector<std::string_view>& words);
  void enter(const Field& field, std::string_view suffix);

  std::vector<std::string> path_;
  std::vector<DocumentedField> fields_;
};

}  // namespace sinew::config
