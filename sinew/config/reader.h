// config/reader.h - visitor that reads structs from a tree.
//
//   config::Node root = config::compose(path, sets);
//   config::Reader reader(root);
//   fields(reader, robot);       // any number of structs from one namespace
//   fields(reader, experiment);
//   reader.finish();             // throws Error with all problems
//
// A value is "number unit", or { value, source, fit | guess, range, uncertainty }. A table's own
// source, fit and guess apply to its keys that have none, and its range to quantities with the
// range's unit; a source never applies to keys of another file or --set. Reading continues after a
// problem, so that all problems are reported.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "sinew/config/changes.h"
#include "sinew/config/node.h"
#include "sinew/config/origin.h"
#include "sinew/units/constants.h"
#include "sinew/units/field.h"

namespace sinew::config {

struct ReaderOptions {
  double atmosphere = units::atmosphere;  // [Pa], between gauge and absolute
  // Returns whether a number without a source in this file is a problem. Absent: never.
  std::function<bool(const std::string& file)> needs_source = {};
  const Changes* changes = &config::changes();  // removed keys
  // true: keys may be missing, and keys that exclude each other are allowed.
  bool of_a_log = false;
};

// Returns the reference of the file's gauge pressures: its air.atmosphere, or the standard
// atmosphere [Pa]. It must be known before other values are read.
double atmosphere_of(const Node& root);

class Reader {
 public:
  using Field = units::Field;

  // Keeps a reference to `root`, which must outlive the reader.
  explicit Reader(const Node& root, ReaderOptions options = {});

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
              std::initializer_list<units::Choice<std::type_identity_t<Enum>>> choices);
  template <class Visit>
  void group(const Field& field, Visit visit);
  template <class T, class Visit>
  void each(const Field& field, std::vector<T>& items, Visit visit);
  template <class T, class Visit>
  void list(const Field& field, std::vector<T>& items, Visit visit);

  // Adds a problem that a visitor finds itself, such as "these two differ". The key is in the
  // current table.
  void report_conflict(std::string_view key, std::string found, std::string expected,
                       std::string try_this = "");

  // Adds a problem for every key that was not read. Throws Error if there is any problem.
  void finish();
  // Throws Error if there is any problem; used if only a part of the file is read.
  void finish_part();

  // Return the origins of all values, the problems, for which finish() throws, and the warnings.
  const Origins& origins() const { return origins_; }
  const std::vector<Problem>& problems() const { return problems_; }
  const std::vector<Problem>& warnings() const { return warnings_; }
  // Returns numbers without a source where a source is not required.
  const std::vector<Problem>& unsourced() const { return unsourced_; }

 private:
  // Table being visited, and its defaults for keys without their own source, fit, guess or range.
  struct Scope {
    const Node* table;
    std::string path;
    const Node* source = nullptr;
    const Node* fit = nullptr;
    const Node* guess = nullptr;
    const Node* range = nullptr;
  };
  // Value: its node and its provenance.
  struct Entry {
    const Node* value;
    Origin origin;
    const Node* range = nullptr;
    bool own_range = false;
  };

  // Keys that describe values in the same table. A struct may still have one as its own field.
  static bool describes_values(const Node& node);
  static const Node* described(const Node& table, std::string_view key);

  std::string path_of(std::string_view key) const;
  const Node* find_field(const Field& field);
  // `expected` describes a missing key in a message, before the field's own description.
  std::optional<Entry> open(const Field& field, std::string default_text, std::string_view unit,
                            const std::string& expected);
  void read_value_table(const Node& table, Entry& entry);
  void add_provenance(const Node& table, Entry& entry);
  void close(Entry entry, bool numeric);
  void check_source(const Origin& origin);

  bool expect_kind(const Node& node, Node::Kind kind, const std::string& path);
  std::optional<double> si_of(const Node& node, std::string_view unit, const std::string& path);
  bool in_bounds(const Field& field, double value, const Node& node, const std::string& path);
  void read_range(const Field& field, Entry& entry, double value);
  void check_uncertainty(const Field& field, const Entry& entry);
  std::optional<std::size_t> pick(const Field& field, const std::vector<std::string_view>& words,
                                  std::string_view default_word);

  const Node* open_container(const Field& field, Node::Kind kind);
  void enter(const Node& table, const std::string& path);
  void leave() { scopes_.pop_back(); }
  std::vector<const Node*> tables_in(const Node& container);
  void find_unused(const Node& table, const std::string& path);
  void refuse_unused(const Node& child, const std::string& path,
                     const std::vector<std::string_view>& known);

  void add_problem(const Node& at, std::string path, std::string found, std::string expected,
                   std::string try_this = "");

  ReaderOptions options_;
  const Node* root_;
  std::vector<Scope> scopes_;
  std::map<const Node*, std::vector<std::string>> requested_;  // keyed by table
  Origins origins_;
  std::vector<Problem> problems_;
  std::vector<Problem> warnings_;
  std::vector<Problem> unsourced_;
};

template <class Enum>
void Reader::choice(const Field& field, Enum& value,
                    std::initializer_list<units::Choice<std::type_identity_t<Enum>>> choices) {
  std::vector<std::string_view> words;
  std::string_view default_word;
  for (const auto& choice : choices) {
    words.push_back(choice.word);
    if (choice.value == value) default_word = choice.word;
  }
  if (const auto index = pick(field, words, default_word)) value = choices.begin()[*index].value;
}

template <class Visit>
void Reader::group(const Field& field, Visit visit) {
  const Node* table = open_container(field, Node::Kind::table);
  if (!table) return;
  enter(*table, path_of(field.name));
  visit(*this);
  leave();
}

template <class T, class Visit>
void Reader::each(const Field& field, std::vector<T>& items, Visit visit) {
  const Node* table = open_container(field, Node::Kind::table);
  if (!table) return;
  items.clear();
  enter(*table, path_of(field.name));
  for (const Node* child : tables_in(*table)) {
    T item{};
    item.name = child->key;
    enter(*child, path_of(child->key));
    visit(*this, item);
    leave();
    items.push_back(std::move(item));
  }
  leave();
}

template <class T, class Visit>
void Reader::list(const Field& field, std::vector<T>& items, Visit visit) {
  const Node* array = open_container(field, Node::Kind::array);
  if (!array) return;
  items.clear();
  for (const Node* child : tables_in(*array)) {
    T item{};
    enter(*child, path_of(field.name) + "[" + std::to_string(items.size()) + "]");
    visit(*this, item);
    leave();
    items.push_back(std::move(item));
  }
}

}  // namespace sinew::config
