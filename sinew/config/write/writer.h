// config/write/writer.h - visitor that writes structs as TOML, in the namespace that Reader reads.
//
//   config::Writer writer(&reader.origins());
//   writer.format("experiment");
//   fields(writer, robot);
//   file << writer.text();
//
// Quantities are in SI with the digits that read back to the same bits; with origins, for human
// readers, in the unit that makes them short (config/quantity.h). A number that is not finite means
// "not set" and is left out.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "sinew/config/node.h"
#include "sinew/config/origin.h"
#include "sinew/units/field.h"

namespace sinew::config {

class Writer {
 public:
  using Field = units::Field;

  // With origins, each value is written with its source, fit, guess, range and uncertainty.
  explicit Writer(const Origins* origins = nullptr) : origins_(origins) {}

  void format(std::string_view kind);  // format = "sinew.<kind>/1"

  // Functions of a visitor, see units/field.h.
  void number(const Field& field, double& value);
  void numbers(const Field& field, std::vector<double>& values);
  void polynomial(const Field& field, std::vector<double>& coefficients, std::string_view per);
  void integer(const Field& field, int& value);
  void flag(const Field& field, bool& value);
  void text(const Field& field, std::string& value);
  void texts(const Field& field, std::vector<std::string>& values);
  void named_numbers(const Field& field, std::map<std::string, double>& values);
  template <class Enum>
  void choice(const Field& field, Enum& value,
              std::initializer_list<units::Choice<std::type_identity_t<Enum>>> choices) {
    for (const auto& choice : choices) {
      if (choice.value == value) return add(make_text(field.name, std::string(choice.word)));
    }
  }
  template <class Visit>
  void group(const Field& field, Visit visit) {
    enter(field.name, Node::Kind::table);
    visit(*this);
    leave();
  }
  template <class T, class Visit>
  void each(const Field& field, std::vector<T>& items, Visit visit) {
    enter(field.name, Node::Kind::table);
    for (T& item : items) {
      enter(item.name, Node::Kind::table);
      visit(*this, item);
      leave();
    }
    leave();
  }
  template <class T, class Visit>
  void list(const Field& field, std::vector<T>& items, Visit visit) {
    enter(field.name, Node::Kind::array);
    for (T& item : items) {
      enter("", Node::Kind::table);
      visit(*this, item);
      leave();
    }
    leave();
  }

  // Returns the TOML of the visited fields.
  std::string text() const;
  // Returns the tree so far; it is complete after the outermost fields() has returned.
  const Node& root() const { return open_.front(); }

 private:
  // Opens a table; one that another struct has written is continued.
  void enter(std::string_view key, Node::Kind kind);
  void leave();
  void add(Node value);
  std::string path_of(std::string_view key) const;

  const Origins* origins_;
  std::vector<Node> open_{Node{}};  // the tables from the root to the one being written
};

// Returns a tree as TOML: values first, then tables under their headers.
std::string to_toml(const Node& root);

// Texts in TOML.

// Returns the text in double quotes. TOML is UTF-8: invalid bytes are replaced.
std::string toml_string(std::string_view text);

}  // namespace sinew::config
