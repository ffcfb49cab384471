#include "sinew/files/keys.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sinew/config/diagnostics.h"
#include "sinew/files/key_tables.h"
#include "sinew/units/letters.h"
#include "sinew/units/quantity.h"
#include "sinew/units/ranges.h"

namespace sinew::files {

// Values given to a list of keys by path: the word of a choice, a text, a number. The fields of a
// table and their units can depend on other values in the table, so that different values show
// different tables.
using Found = std::map<std::string, std::string>;

namespace {

// --- keys that depend on other values ---

// Path whose value affects other keys: each value, and its description for the user.
struct DecidingPath {
  struct Value {
    std::string text, condition;
  };
  std::string path;
  std::vector<Value> values;
};

using KeysByPath = std::map<std::string, Key>;  // keyed by path
KeysByPath by_path(const std::vector<Key>& keys) {
  KeysByPath out;
  for (const Key& key : keys) out.emplace(key.path, key);
  return out;
}

std::string text_of(const units::VisitedField& f, double value) {
  return std::isfinite(value) ? units::format_quantity(value, f.field.unit) : "not set";
}

// Returns the default of a field as it would be written.
std::string default_of(const units::VisitedField& f) {
  std::string all;
  switch (f.type) {
    case KeyType::number:
      return text_of(f, *f.number);
    case KeyType::numbers:
      for (const double value : *f.numbers) all += (all.empty() ? "" : ", ") + text_of(f, value);
      return all;
    case KeyType::whole:
      return std::to_string(*f.whole);
    case KeyType::flag:
      return *f.flag ? "true" : "false";
    case KeyType::text:
      return *f.text;
    case KeyType::texts:
      return fmt::format("{}", fmt::join(*f.texts, ", "));
    case KeyType::choice:
      return f.choice < f.words.size() ? std::string(f.words[f.choice]) : "";
    default:
      return "";
  }
}

Key key_of(std::string_view kind, const units::VisitedField& f) {
  Key key{.kind = std::string(kind),
          .path = std::string(f.path),
          .type = f.type,
          .per = std::string(f.per),
          .required = !f.field.optional,
          .choices = {f.words.begin(), f.words.end()},
          .doc = std::string(f.field.doc)};
  if (!key.required) key.default_text = default_of(f);
  const bool quantity = f.type == KeyType::number || f.type == KeyType::numbers;
  // A polynomial has only the limits of its units.
  if (quantity || f.type == KeyType::polynomial) key.unit = f.field.unit;
  if (quantity || f.type == KeyType::whole) {
    key.min = f.field.min;
    key.max = f.field.max;
  }
  if (quantity) {
    key.least = f.field.least;
    key.most = units::range_of(f.field.unit).most;
    key.why = f.field.why;
  }
  return key;
}

void set(units::VisitedField& f, const std::string& value) {
  if (f.number) *f.number = std::stod(value);
  if (f.text) *f.text = value;
  if (const auto word = std::ranges::find(f.words, value); word != f.words.end())
    f.choice = static_cast<std::size_t>(word - f.words.begin());
}

std::vector<Key> keys_with(std::string_view kind, const Found& found) {
  std::vector<Key> out;
  units::EachField visitor(
      [&](units::VisitedField& f) {
        if (f.type == KeyType::item) return;
        out.push_back(key_of(kind, f));
        if (const auto given = found.find(std::string(f.path)); given != found.end())
          set(f, given->second);
      },
      units::EachField::Items::pattern);
  visit_tables(visitor, kind);
  return out;
}

std::string last_of(std::string_view path) {
  return std::string(path.substr(path.rfind('.') == path.npos ? 0 : path.rfind('.') + 1));
}

// Returns paths with free values that affect a unit or whether a key is required.
std::vector<DecidingPath> other_deciding(std::string_view kind) {
  if (kind == "robot")
    return {{"joint.<name>.spring", {{"0", "without a spring"}, {"1", "with a spring"}}}};
  if (kind != "experiment") return {};
  const auto condition = [](std::string_view key, const std::string& word) -> DecidingPath::Value {
    return {word, fmt::format("{} = \"{}\"", key, word)};
  };
  return {
      {"phase.<name>.until.measure",
       {condition("measure", "foot.normal_force"), condition("measure", "foot.friction_force"),
        condition("measure", "joint.<name>.angle"), condition("measure", "joint.<name>.stiffness"),
        condition("measure", "muscle.<name>.tension")}},
      {"change[].key",
       {condition("key", "control.angle.<name>"), condition("key", "control.stiffness.<name>"),
        condition("key", "control.gains.<name>.angle"),
        condition("key", "control.gains.<name>.stiffness"),
        condition("key", "control.gains.<name>.velocity")}}};
}

// Returns every choice; the default of its struct comes first.
std::vector<DecidingPath> choices_among(const std::vector<Key>& keys, std::string_view kind) {
  std::vector<DecidingPath> out = other_deciding(kind);
  for (const Key& key : keys) {
    if (key.type != KeyType::choice) continue;
    DecidingPath one{.path = key.path};
    for (const std::string& word : key.choices)
      one.values.push_back({word, fmt::format("{} = \"{}\"", last_of(key.path), word)});
    out.push_back(std::move(one));
  }
  return out;
}

// Returns whether two keys appear equal to a user; the default does not depend on other values.
bool same(const Key* a, const Key* b) {
  if (!a || !b) return a == b;
  return a->type == b->type && a->unit == b->unit && a->per == b->per && a->min == b->min &&
         a->max == b->max && a->least == b->least && a->why == b->why &&
         a->required == b->required && a->doc == b->doc && a->choices == b->choices;
}

// Keys listed with each value of a deciding path.
struct KeyVariants {
  DecidingPath of;
  std::vector<KeysByPath> listings;

  const Key* at(std::size_t value, const std::string& path) const {
    const auto found = listings[value].find(path);
    return found == listings[value].end() ? nullptr : &found->second;
  }
  bool decides(const std::string& path) const {
    for (std::size_t k = 1; k < listings.size(); ++k)
      if (!same(at(k, path), at(0, path))) return true;
    return false;
  }
  // Returns the values with which the path's key is accepted: `kind = "angle" or "velocity"`.
  template <class Accepts>
  std::string values_with(const std::string& path, const Accepts& accepts) const {
    std::string out;
    for (std::size_t k = 0; k < listings.size(); ++k) {
      if (!accepts(at(k, path))) continue;
      const std::string& condition = of.values[k].condition;
      const std::size_t word = condition.find('"');
      out += out.empty() || word == condition.npos ? condition : " or " + condition.substr(word);
    }
    return out;
  }
  // Returns the values with which the path has this key: `kind = "angle" or "velocity"`.
  std::string condition_of(const std::string& path, const Key* key) const {
    return values_with(path, [&](const Key* one) { return same(one, key); });
  }
  // Returns the values with which the path exists; empty: all of them.
  std::string presence_condition(const std::string& path) const {
    bool always = true;
    const std::string out = values_with(path, [&](const Key* one) {
      always = always && one != nullptr;
      return one != nullptr;
    });
    return always ? "" : out;
  }
};

std::string joined(const std::string& a, const std::string& b) {
  return a.empty() || b.empty() ? a + b : a + " and " + b;
}

// Adds the rows of a path: one for each variant of the key.
void add_rows(const std::string& path, const std::vector<KeyVariants>& variants,
              std::vector<Key>& out) {
  std::vector<const KeyVariants*> deciding;
  for (const KeyVariants& one : variants)
    if (one.decides(path)) deciding.push_back(&one);
  const auto add = [&](const Key& key, std::string when) {
    out.push_back(key);
    out.back().when = std::move(when);
  };
  if (const Key* first = variants.front().at(0, path)) {
    std::string when;
    for (const KeyVariants* one : deciding) when = joined(when, one->condition_of(path, first));
    add(*first, when);
  }
  for (const KeyVariants* one : deciding) {
    std::vector<const Key*> listed = {variants.front().at(0, path)};
    for (std::size_t k = 0; k < one->listings.size(); ++k) {
      const Key* key = one->at(k, path);
      const auto is_it = [&](const Key* other) { return same(other, key); };
      if (!key || std::ranges::any_of(listed, is_it)) continue;
      listed.push_back(key);
      std::string when;
      for (const KeyVariants* other : deciding)
        when = joined(
            when, other == one ? one->condition_of(path, key) : other->presence_condition(path));
      add(*key, when);
    }
  }
}

// Merged order of all paths: one that the first listing lacks comes after its neighbour.
struct Order {
  std::vector<std::string> paths;
  std::set<std::string, std::less<>> known;

  void merge(const std::vector<Key>& seen) {
    std::string before;
    for (const Key& key : seen) {
      if (known.insert(key.path).second) {
        const auto neighbour = std::ranges::find(paths, before);
        paths.insert(neighbour == paths.end() ? neighbour : neighbour + 1, key.path);
      }
      before = key.path;
    }
  }
};

std::vector<Key> list_tables(std::string_view kind) {
  const std::vector<DecidingPath> places = choices_among(keys_with(kind, {}), kind);
  Found first;
  for (const DecidingPath& one : other_deciding(kind)) first[one.path] = one.values.front().text;
  Order order;
  order.merge(keys_with(kind, first));
  std::vector<KeyVariants> variants = {{.of = {}, .listings = {by_path(keys_with(kind, first))}}};
  for (const DecidingPath& place : places) {
    KeyVariants one{.of = place};
    for (const DecidingPath::Value& value : place.values) {
      Found found = first;
      found[place.path] = value.text;
      const std::vector<Key> seen = keys_with(kind, found);
      order.merge(seen);
      one.listings.push_back(by_path(seen));
    }
    variants.push_back(std::move(one));
  }
  std::vector<Key> out;
  for (const std::string& path : order.paths) add_rows(path, variants, out);
  return out;
}

// --- keys that config/compose.h reads before the tables ---

Key text_key(std::string_view kind, std::string path, std::string doc, bool required = false) {
  return {.kind = std::string(kind),
          .path = std::move(path),
          .required = required,
          .doc = std::move(doc)};
}

std::vector<Key> composed(std::string_view kind) {
  const auto text = [&](std::string path, std::string doc, bool required = false) {
    return text_key(kind, std::move(path), std::move(doc), required);
  };
  Key files = text("files", "other files of the machine, relative to this one");
  files.type = KeyType::table;
  const Key actuator = text("files.actuator", "actuator file, or a list of them");
  const Key valves = text("files.valves", "valves file"),
            gains = text("files.gains", "gain*.dat, table of gains");
  const Key version = text("sinew_version", "version of the program that ran, in a resolved file");
  const Key timing = text("files.valve_timing", "predict.dat, table of the valves' pulses");
  const Key wiring = text("files.wiring", "wiring file");
  const Key name = text("name", "name in other files; absent: the file's");
  if (kind == "experiment")
    return {version, text("robot", "robot file; its tables can be changed here"), files, gains};
  if (kind == "robot")
    return {text("name", "name of the robot; in a resolved experiment the key is robot_name", true),
            files,
            actuator,
            valves,
            wiring,
            timing,
            gains};
  if (kind == "rig") return {version, files, actuator, valves};
  if (kind == "valves")
    return {name,
            text("valve.<name>.catalogue",
                 "valve of data/valves.toml, or of catalogue_file; other keys change its values"),
            text("valve.<name>.catalogue_file", "valves file that has it, relative to this file")};
  if (kind == "actuator" || kind == "wiring") return {name};
  return {};
}

// Returns the keys of every file and every table of values.
std::vector<Key> any_keys() {
  const Key flag{.kind = "any", .type = KeyType::flag, .default_text = "false"};
  Key fit = flag, guess = flag, range = text_key("any", "range", "");
  fit.path = "fit";
  fit.doc = "true: the value, or all values of a table, are chosen for agreement";
  guess.path = "guess";
  guess.doc = "true: the value, or all values of a table, are not published";
  range.type = KeyType::texts;
  range.doc = "lowest and highest possible value, or share, of a value or a table";
  return {text_key("any", "format", "\"sinew.<kind>/1\"", true),
          text_key("any", "base",
                   "a file of the same kind, which this one changes; its `reported` figures are "
                   "not inherited"),
          text_key("any", "source", "source of a value, or of all values of a table"),
          fit,
          guess,
          range,
          text_key("any", "uncertainty",
                   "uncertainty of a value: { value = \"3 N\", uncertainty = \"5 %\" }")};
}

std::vector<Key> list_keys(std::string_view kind) {
  if (kind == "any") return any_keys();
  std::vector<Key> out = composed(kind);
  for (Key& key : list_tables(kind)) {
    // A robot's file has `name`, which becomes this key.
    if (kind == "robot" && key.path == "robot_name") key.required = false;
    if (key.path.starts_with("control.gains.<name>.")) key.default_text = "the robot's";
    out.push_back(std::move(key));
  }
  return out;
}

}  // namespace

const std::vector<std::string>& key_kinds() {
  static const std::vector<std::string> kinds = {"robot",      "actuator", "valves", "wiring",
                                                 "experiment", "rig",      "plan",   "tuning",
                                                 "mapping",    "settings", "any"};
  return kinds;
}

const std::vector<Key>& keys() {
  static const std::vector<Key> all = [] {
    std::vector<Key> out;
    for (const std::string& kind : key_kinds())
      for (Key& key : list_keys(kind)) out.push_back(std::move(key));
    return out;
  }();
  return all;
}

std::vector<Key> keys_of(std::string_view kind) {
  const std::vector<std::string_view> kinds(key_kinds().begin(), key_kinds().end());
  if (std::ranges::find(kinds, kind) == kinds.end())
    config::fail({"kind", 0, 0}, "", config::in_quotes(kind), config::either(kinds),
                 std::string(config::closest(kind, kinds)));
  std::vector<Key> out;
  for (const Key& key : keys())
    if (key.kind == kind) out.push_back(key);
  return out;
}

std::vector<std::string> kinds_within(std::string_view kind) {
  if (kind == "experiment") return {"experiment", "robot", "actuator", "valves", "wiring"};
  if (kind == "robot") return {"robot", "actuator", "valves", "wiring"};
  if (kind == "rig") return {"rig", "actuator", "valves"};
  return {std::string(kind)};
}

std::string range_of(const Key& key) {
  if (key.unit.empty() && key.type != KeyType::whole) return "";
  std::string out = units::range_text(key.min, key.max, key.unit);
  if (key.least > 0) {
    const std::string least = "0, or at least " + units::format_quantity(key.least, key.unit);
    out = key.min == 0 && key.max == units::unbounded ? least : out + "; " + least;
  }
  return out;
}

std::string_view to_text(KeyType type) {
  constexpr std::string_view names[] = {"number", "numbers", "polynomial", "whole",  "flag", "text",
                                        "texts",  "choice",  "table",      "tables", "list"};
  return names[static_cast<std::size_t>(type)];
}

// Search for keys by a name or by words.

namespace {

using Parts = std::vector<std::string>;

// Splits a path into parts: "fault[0].at" into fault[] and at.
Parts parts_of(std::string_view path) {
  Parts out;
  for (std::size_t from = 0; from <= path.size();) {
    const std::size_t dot = std::min(path.find('.', from), path.size());
    std::string part(path.substr(from, dot - from));
    if (const std::size_t bracket = part.find('['); bracket != part.npos && part.ends_with(']')) {
      const std::string inside = part.substr(bracket + 1, part.size() - bracket - 2);
      const bool number = inside.find_first_not_of("0123456789") == inside.npos;
      if (number) part = part.substr(0, bracket) + "[]";
    }
    out.push_back(std::move(part));
    from = dot + 1;
  }
  return out;
}

std::string without_brackets(std::string_view part) {
  return std::string(part.ends_with("[]") ? part.substr(0, part.size() - 2) : part);
}

// Returns whether the key begins with these parts; brackets of a list may be left out.
bool begins_as(const Parts& key, const Parts& path) {
  if (path.size() > key.size()) return false;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (key[i] == "<name>" ? path[i].empty()
                           : without_brackets(key[i]) != without_brackets(path[i]))
      return false;
  }
  return true;
}

bool has_word(const Key& key, const std::string& word) {
  if (units::lower(key.path).find(word) != std::string::npos) return true;
  if (units::lower(key.doc).find(word) != std::string::npos) return true;
  return std::ranges::any_of(key.choices, [&](const std::string& choice) {
    return units::lower(choice).find(word) != std::string::npos;
  });
}

// Returns the keys that a word with a dot names, or else those below it; may be empty.
std::vector<Key> named(const std::vector<Key>& among, std::string_view word) {
  std::vector<Key> exact, below;
  const Parts path = parts_of(word);
  for (const Key& key : among) {
    if (is_key(key, word) && key.type != KeyType::table && key.type != KeyType::tables &&
        key.type != KeyType::list)
      exact.push_back(key);
    if (begins_as(parts_of(key.path), path)) below.push_back(key);
  }
  return exact.empty() ? below : exact;
}

// Returns the key's path with the names in the word: joint.hip.damping for "joint.hip.dampnig".
std::string in_names_of(const Key& key, const Parts& word) {
  Parts path = parts_of(key.path);
  std::string out;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (path[i] == "<name>" && i < word.size() && !word[i].empty()) path[i] = word[i];
    out += (out.empty() ? "" : ".") + path[i];
  }
  return out;
}

// Returns the key nearest to an unknown word; for a word without a dot, the nearest part of a key.
std::string nearest(const std::vector<Key>& among, std::string_view word) {
  const bool path = word.find('.') != word.npos;
  const Parts names = parts_of(word);
  std::set<std::string> candidates;
  for (const Key& key : among) {
    if (path) {
      candidates.insert(in_names_of(key, names));
    } else {
      for (const std::string& part : parts_of(key.path))
        if (part != "<name>") candidates.insert(without_brackets(part));
    }
  }
  return std::string(config::closest(word, {candidates.begin(), candidates.end()}));
}

[[noreturn]] void refuse(const std::string& found, const std::string& expected,
                         const std::string& try_this) {
  config::fail({"keys", 0, 0}, "", found, expected, try_this);
}

std::vector<Key> with_word(const std::vector<Key>& among, const std::string& word) {
  if (word.find('.') != word.npos) {
    if (std::vector<Key> found = named(among, word); !found.empty()) return found;
  }
  std::vector<Key> out;
  const std::string small = units::lower(word);
  for (const Key& key : among)
    if (has_word(key, small)) out.push_back(key);
  return out;
}

}  // namespace

bool is_key(const Key& key, std::string_view path) {
  const Parts own = parts_of(key.path);
  Parts asked = parts_of(path);
  return own.size() == asked.size() && begins_as(own, asked);
}

std::string unit_of(std::string_view path) {
  constexpr std::array of_machines{"robot", "actuator", "valves", "wiring", "experiment", "rig"};
  const auto find = [&](std::string_view whole) {
    std::string unit;
    bool differ = false;
    for (const Key& key : keys()) {
      if (std::ranges::count(of_machines, key.kind) == 0 || !is_key(key, whole)) continue;
      differ = differ || (!unit.empty() && unit != key.unit);
      unit = key.unit;
    }
    return differ ? std::string() : unit;
  };
  const std::string unit = find(path);
  return unit.empty() ? find(fmt::format("actuator.name.{}", path)) : unit;
}

std::vector<Key> find_keys(const std::vector<std::string>& words, std::string_view kind) {
  const std::vector<Key> all = kind.empty() ? keys() : keys_of(kind);
  const std::string where = kind.empty() ? "" : fmt::format(" of kind {}", kind);
  std::vector<Key> found = all;
  for (const std::string& word : words) {
    const std::vector<Key> with = with_word(all, word);
    if (with.empty() || word.empty()) {
      const std::string near = nearest(all, word);
      refuse(config::in_quotes(word),
             fmt::format("a key{}, the beginning of one, or a word of its description", where),
             near.empty() ? "sinew keys, for the tables" : near);
    }
    std::vector<Key> both;
    for (const Key& key : found)
      if (std::ranges::any_of(with, [&](const Key& other) {
            return other.kind == key.kind && other.path == key.path && other.when == key.when;
          }))
        both.push_back(key);
    if (both.empty())
      refuse(config::in_quotes(word), fmt::format("a word that a key{} has with the others", where),
             "fewer words");
    found = std::move(both);
  }
  return found;
}

}  // namespace sinew::files
