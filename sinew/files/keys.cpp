#include "sinew/files/keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "sinew/config/diagnostics.h"
#include "sinew/config/quantity.h"
#include "sinew/files/key_lister.h"
#include "sinew/files/key_tables.h"

namespace sinew::files {

namespace {

// --- keys that change with what stands beside them ---

// A place whose value decides about other keys: each value, and how a person says that it is there.
struct Deciding {
  struct Value {
    std::string text, said;
  };
  std::string path;
  std::vector<Value> values;
};

using Seen = std::map<std::string, Key>;  // by path
Seen by_path(const std::vector<Key>& keys) {
  Seen out;
  for (const Key& key : keys) out.emplace(key.path, key);
  return out;
}

std::vector<Key> look(std::string_view kind, const Found& found) {
  KeyLister lister(kind, found);
  visit_tables(lister, kind);
  return std::move(lister.keys);
}

std::string last_of(std::string_view path) {
  return std::string(path.substr(path.rfind('.') == path.npos ? 0 : path.rfind('.') + 1));
}

// Values that no list of words names, and that decide about a unit or whether a key is needed.
std::vector<Deciding> other_deciding(std::string_view kind) {
  if (kind == "robot")
    return {{"joint.<name>.spring", {{"0", "without a spring"}, {"1", "with a spring"}}}};
  if (kind != "experiment") return {};
  const auto said = [](std::string_view key, const std::string& word) -> Deciding::Value {
    return {word, fmt::format("{} = \"{}\"", key, word)};
  };
  return {
      {"phase.<name>.until.measure",
       {said("measure", "foot.normal_force"), said("measure", "foot.friction_force"),
        said("measure", "joint.<name>.angle"), said("measure", "joint.<name>.stiffness"),
        said("measure", "muscle.<name>.tension")}},
      {"change[].key",
       {said("key", "control.angle.<name>"), said("key", "control.stiffness.<name>"),
        said("key", "control.gains.<name>.angle"), said("key", "control.gains.<name>.stiffness"),
        said("key", "control.gains.<name>.velocity")}}};
}

// Every choice, with the word that is the struct's own first.
std::vector<Deciding> choices_among(const std::vector<Key>& keys, std::string_view kind) {
  std::vector<Deciding> out = other_deciding(kind);
  for (const Key& key : keys) {
    if (key.type != KeyType::choice) continue;
    Deciding one{.path = key.path};
    for (const std::string& word : key.choices)
      one.values.push_back({word, fmt::format("{} = \"{}\"", last_of(key.path), word)});
    out.push_back(std::move(one));
  }
  return out;
}

// What a person would notice; the default does not follow from the words beside it.
bool same(const Key* a, const Key* b) {
  if (!a || !b) return a == b;
  return a->type == b->type && a->unit == b->unit && a->per == b->per && a->min == b->min &&
         a->max == b->max && a->least == b->least && a->why == b->why &&
         a->required == b->required && a->doc == b->doc && a->choices == b->choices;
}

// What was seen with each value of a place.
struct Looks {
  Deciding of;
  std::vector<Seen> seen;

  const Key* at(std::size_t value, const std::string& path) const {
    const auto found = seen[value].find(path);
    return found == seen[value].end() ? nullptr : &found->second;
  }
  bool decides(const std::string& path) const {
    for (std::size_t k = 1; k < seen.size(); ++k)
      if (!same(at(k, path), at(0, path))) return true;
    return false;
  }
  // `kind = "angle" or "velocity"`: the values with which the key is that one.
  std::string said_of(const std::string& path, const Key* key) const {
    std::string out;
    for (std::size_t k = 0; k < seen.size(); ++k) {
      if (!same(at(k, path), key)) continue;
      const std::string& said = of.values[k].said;
      const std::size_t word = said.find('"');
      out += out.empty() || word == said.npos ? said : " or " + said.substr(word);
    }
    return out;
  }
  // The values with which there is such a key at all; empty: all of them.
  std::string said_where_it_is(const std::string& path) const {
    std::string out;
    bool always = true;
    for (std::size_t k = 0; k < seen.size(); ++k) {
      const std::string& said = of.values[k].said;
      const std::size_t word = said.find('"');
      if (!at(k, path)) {
        always = false;
      } else {
        out += out.empty() || word == said.npos ? said : " or " + said.substr(word);
      }
    }
    return always ? "" : out;
  }
};

std::string joined(const std::string& a, const std::string& b) {
  return a.empty() || b.empty() ? a + b : a + " and " + b;
}

// The rows of one path: one for each of the keys that it is.
void add_rows(const std::string& path, const std::vector<Looks>& looks, std::vector<Key>& out) {
  std::vector<const Looks*> deciding;
  for (const Looks& one : looks)
    if (one.decides(path)) deciding.push_back(&one);
  const auto add = [&](const Key& key, std::string when) {
    out.push_back(key);
    out.back().when = std::move(when);
  };
  if (const Key* first = looks.front().at(0, path)) {
    std::string when;
    for (const Looks* one : deciding) when = joined(when, one->said_of(path, first));
    add(*first, when);
  }
  for (const Looks* one : deciding) {
    std::vector<const Key*> told = {looks.front().at(0, path)};
    for (std::size_t k = 0; k < one->seen.size(); ++k) {
      const Key* key = one->at(k, path);
      const auto is_it = [&](const Key* other) { return same(other, key); };
      if (!key || std::ranges::any_of(told, is_it)) continue;
      told.push_back(key);
      std::string when;
      for (const Looks* other : deciding)
        when = joined(when, other == one ? one->said_of(path, key) : other->said_where_it_is(path));
      add(*key, when);
    }
  }
}

// The paths of all looks: one that the first did not see stands behind its neighbour.
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
  const std::vector<Deciding> places = choices_among(look(kind, {}), kind);
  Found first;
  for (const Deciding& one : other_deciding(kind)) first[one.path] = one.values.front().text;
  Order order;
  order.merge(look(kind, first));
  std::vector<Looks> looks = {{.of = {}, .seen = {by_path(look(kind, first))}}};
  for (const Deciding& place : places) {
    Looks one{.of = place};
    for (const Deciding::Value& value : place.values) {
      Found found = first;
      found[place.path] = value.text;
      const std::vector<Key> seen = look(kind, found);
      order.merge(seen);
      one.seen.push_back(by_path(seen));
    }
    looks.push_back(std::move(one));
  }
  std::vector<Key> out;
  for (const std::string& path : order.paths) add_rows(path, looks, out);
  return out;
}

// --- keys that config/compose.h takes, before the tables are read ---

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
  const Key files{.kind = std::string(kind),
                  .path = "files",
                  .type = KeyType::table,
                  .doc = "other files, relative to this one"};
  const Key actuator = text("files.actuator", "an actuator file, or a list of them");
  const Key valves = text("files.valves", "valves file"), gains = text("files.gains", "gain*.dat");
  const Key version = text("sinew_version", "that ran, in a resolved file");
  const Key timing = text("files.valve_timing", "predict.dat, the table of the valves' pulses");
  const Key wiring = text("files.wiring", "wiring file");
  const Key name = text("name", "by which others call it; absent: the file's");
  if (kind == "experiment")
    return {version, text("robot", "robot file; its tables can be changed here"), files, gains};
  if (kind == "robot")
    return {text("name", "of the robot; beside an experiment it is robot_name", true),
            files,
            actuator,
            valves,
            wiring,
            timing,
            gains};
  if (kind == "rig") return {version, files, actuator, valves};
  if (kind == "actuator" || kind == "valves" || kind == "wiring") return {name};
  return {};
}

// What every file can say, and every table of values.
std::vector<Key> any_keys() {
  const Key flag{.kind = "any", .type = KeyType::flag, .default_text = "false"};
  Key fit = flag, guess = flag, range = text_key("any", "range", "");
  fit.path = "fit";
  fit.doc = "of a value, or of all in a table: chosen so that something agrees";
  guess.path = "guess";
  guess.doc = "of a value, or of all in a table: nobody published it";
  range.type = KeyType::texts;
  range.doc = "of a value, or of all in a table: lowest and highest that it could be";
  return {text_key("any", "format", "\"sinew.<kind>/1\"", true),
          text_key("any", "base",
                   "a file of the same kind, which this one changes; its `reported` figures are "
                   "not inherited"),
          text_key("any", "source", "of a value, or of all in a table: where it comes from"),
          fit,
          guess,
          range,
          text_key("any", "uncertainty", "of a value: { value = \"3 N\", uncertainty = \"5 %\" }")};
}

std::vector<Key> list_keys(std::string_view kind) {
  if (kind == "any") return any_keys();
  std::vector<Key> out = composed(kind);
  for (Key& key : list_tables(kind)) {
    // A robot's file says `name`, which becomes it.
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
  if (key.type == KeyType::whole) {
    const bool low = key.min != -units::unbounded, high = key.max != units::unbounded;
    if (low && high) return fmt::format("{:.0f} to {:.0f}", key.min, key.max);
    return low    ? fmt::format("at least {:.0f}", key.min)
           : high ? fmt::format("at most {:.0f}", key.max)
                  : "";
  }
  if (key.unit.empty()) return "";
  const std::string low = config::format_quantity(key.min, key.unit);
  const std::string high = config::format_quantity(key.max, key.unit);
  const bool none = key.min == -units::unbounded && key.max == units::unbounded;
  std::string out = none                           ? ""
                    : key.max == units::unbounded  ? "at least " + low
                    : key.min == -units::unbounded ? "at most " + high
                                                   : fmt::format("{} to {}", low, high);
  if (key.least > 0) {
    const std::string least = "0, or at least " + config::format_quantity(key.least, key.unit);
    out = key.min == 0 && key.max == units::unbounded ? least : out + "; " + least;
  }
  return out;
}

std::string_view to_text(KeyType type) {
  switch (type) {
    case KeyType::number:
      return "number";
    case KeyType::numbers:
      return "numbers";
    case KeyType::polynomial:
      return "polynomial";
    case KeyType::whole:
      return "whole";
    case KeyType::flag:
      return "flag";
    case KeyType::text:
      return "text";
    case KeyType::texts:
      return "texts";
    case KeyType::choice:
      return "choice";
    case KeyType::table:
      return "table";
    case KeyType::tables:
      return "tables";
    case KeyType::list:
      return "list";
  }
  return "";
}

}  // namespace sinew::files
