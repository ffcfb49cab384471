// config/diagnostics.h - faults of a file, reported all at once; and lookup of a list's item by
// name.
//
// A problem is printed as `file:line:col: key: found …; expected …; try …`, one line each.
#pragma once

#include <cstddef>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/units/letters.h"
#include "sinew/units/mistake.h"

namespace sinew::config {

using units::closest, units::in_quotes;

// Place in a file. line = 0: there is no line (a missing file, "--set").
struct Location {
  std::string file;
  int line = 0;
  int column = 0;
};

// Fault of a file or a setting: place, description and advice.
struct Problem {
  Location where;
  std::string key;  // dotted path in the resolved namespace; may be empty
  std::string found;
  std::string expected;
  std::string try_this;  // empty: no suggestion
};

// Returns "file:line:column: key: found …; expected …; try …".
std::string to_text(const Problem& problem);
std::string to_text(const std::vector<Problem>& problems);  // one line each

// Exception with all problems of a file; what() is their text.
class Error : public std::exception {
 public:
  // Formats the text of all problems, or of one.
  explicit Error(std::vector<Problem> problems);
  explicit Error(const Problem& problem);

  // Return the problems as a list, and as one text.
  const std::vector<Problem>& problems() const { return problems_; }
  const char* what() const noexcept override { return text_.c_str(); }

 private:
  std::vector<Problem> problems_;
  std::string text_;
};

// Throws Error with one problem.
[[noreturn]] void fail(Location where, std::string key, std::string found, std::string expected,
                       std::string try_this = "");
[[noreturn]] void fail(Location where, std::string key, units::Mistake mistake);

// Returns the result of closest() in quotes, for Problem::try_this.
std::string closest_in_quotes(std::string_view word,
                              const std::vector<std::string_view>& candidates);

// Returns the names of items, for closest() and either().
template <class Items>
std::vector<std::string_view> names_of(const Items& items) {
  std::vector<std::string_view> names;
  for (const auto& item : items) names.push_back(item.name);
  return names;
}

// Returns "hip, knee or ankle".
std::string either(const std::vector<std::string_view>& words);

// Returns "a, b, c": at most `most` of the words, then how many more there are.
std::string listed(const std::vector<std::string>& words, std::size_t most);

// Lookup of a list's item by name; a single item needs no name.

// Returns the item with that name, or the only item if the name is "". Throws Error that begins
// with `where`: a file, a key or an option; without items it begins with `file`, if that is given.
// `what` is the kind of items, "valve".
template <class Item>
const Item& named(const std::vector<Item>& items, const std::string& name, std::string_view where,
                  std::string_view what, std::string_view file = "") {
  if (name.empty() && items.size() == 1) return items.front();
  for (const Item& item : items)
    if (item.name == name) return item;
  const std::vector<std::string_view> names = names_of(items);
  const std::string no = "no " + std::string(what);
  if (items.empty())
    fail({std::string(file.empty() ? where : file), 0, 0}, "", no, "a file with one");
  fail({std::string(where), 0, 0}, "", name.empty() ? no : in_quotes(name), either(names),
       closest_in_quotes(name, names));
}

// Collects the faults of a file.
class Problems {
 public:
  // Takes the name of the file that has the faults. A file of many rows reports the first `most`
  // and the number of the others.
  explicit Problems(std::string file, std::size_t most = 8) : file_(std::move(file)), most_(most) {}

  // Adds a fault; `line` 0: it belongs to no line.
  void add(int line, int column, std::string key, std::string found, std::string expected,
           std::string try_this = "");
  // Adds a fault of any file.
  void add(Problem problem);

  // Returns the number of faults.
  std::size_t count() const { return count_; }

  // Throws Error if there are any faults.
  void finish();

 private:
  std::string file_;
  std::size_t most_;
  std::vector<Problem> problems_;
  std::size_t count_ = 0;
};

}  // namespace sinew::config
