// config/diagnostics.h - all faults of a file, reported at once; and one item of a list by its
// name.
//
// A problem reads `file:line:col: key: found …; expected …; try …`, one line each.
#pragma once

#include <exception>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::config {

// Where something stands. line = 0: the place has no lines (a file that is missing, "--set").
struct Location {
  std::string file;
  int line = 0;
  int column = 0;
};

// One thing that is wrong with a file or a setting: where, what, and what to do.
struct Problem {
  Location where;
  std::string key;  // dotted path in the resolved namespace; empty where there is none
  std::string found;
  std::string expected;
  std::string try_this;  // empty: nothing to suggest
};

// Returns "file:line:column: key: found …; expected …; try …".
std::string to_text(const Problem& problem);
std::string to_text(const std::vector<Problem>& problems);  // one line each

// All problems of one file. what() is their text.
class Error : public std::exception {
 public:
  // Makes the words of all problems, or of one.
  explicit Error(std::vector<Problem> problems);
  explicit Error(const Problem& problem);

  // Returns each of them; and all of them as one text.
  const std::vector<Problem>& problems() const { return problems_; }
  const char* what() const noexcept override { return text_.c_str(); }

 private:
  std::vector<Problem> problems_;
  std::string text_;
};

// Throws Error with one problem.
[[noreturn]] void fail(Location where, std::string key, std::string found, std::string expected,
                       std::string try_this = "");

// The candidate most like `word`, empty where none is near enough to be a typing error.
std::string_view closest(std::string_view word, const std::vector<std::string_view>& candidates);

// The same in quotes, for Problem::try_this.
std::string closest_in_quotes(std::string_view word,
                              const std::vector<std::string_view>& candidates);

// Of things that have one, for the two above and below.
template <class Items>
std::vector<std::string_view> names_of(const Items& items) {
  std::vector<std::string_view> names;
  for (const auto& item : items) names.push_back(item.name);
  return names;
}

// "hip, knee or ankle"
std::string either(const std::vector<std::string_view>& words);

// In double quotes; what is too long for a message is cut.
std::string in_quotes(std::string_view text);

// One of a list by its name; the only one needs no name.

// Returns the item of that name, or the only one where the name is "". Throws Error that begins
// with `where`: a file, a key or an option; `what` is what the items are, "valve".
template <class Item>
const Item& named(const std::vector<Item>& items, const std::string& name, std::string_view where,
                  std::string_view what) {
  if (name.empty() && items.size() == 1) return items.front();
  for (const Item& item : items)
    if (item.name == name) return item;
  const std::vector<std::string_view> names = names_of(items);
  const std::string no = "no " + std::string(what);
  fail({std::string(where), 0, 0}, "",
       items.empty()  ? no + " in the file"
       : name.empty() ? no
                      : in_quotes(name),
       items.empty() ? "a file with one" : either(names), closest_in_quotes(name, names));
}

}  // namespace sinew::config
