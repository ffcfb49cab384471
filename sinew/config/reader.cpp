#include "sinew/config/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sinew/config/diagnostics.h"
#include "sinew/units/quantity.h"
#include "sinew/units/ranges.h"

namespace sinew::config {

namespace {

// --- texts for messages: defaults and allowed values ---

// Returns a default as it would be written. A default that is not finite is "not set".
std::string default_text(double value, std::string_view unit) {
  return std::isfinite(value) ? units::format_quantity(value, unit) : "not set";
}

std::string joined(const std::vector<double>& values, std::string_view unit) {
  std::string text;
  for (double v : values) text += (text.empty() ? "" : ", ") + default_text(v, unit);
  return text;
}

// Returns the description of a number with the field's limits: "m (length), at least 0 m",
// "a whole number, 1 to 8".
std::string number_text(const std::string& what, const units::Field& field) {
  const std::string range = units::range_text(field.min, field.max, field.unit);
  return range.empty() ? what : what + ", " + range;
}

// Returns the words of a choice: `"raises angle" or "lowers angle"`.
std::string words_text(const std::vector<std::string_view>& words) {
  std::vector<std::string> quoted;
  for (const std::string_view word : words) quoted.push_back(in_quotes(word));
  return either({quoted.begin(), quoted.end()});
}

// Returns "0 m to 1 m: a foot is no longer"; only the text if there is no reason.
std::string with_reason(std::string text, std::string_view why) {
  return why.empty() ? text : fmt::format("{}: {}", text, why);
}

// Returns the range that the value violates, the field's own or its unit's; empty if none.
std::string out_of_bounds(const units::Field& field, double value) {
  if (units::is_within(field, value)) return {};
  if (!(value >= field.min && value <= field.max)) {
    return with_reason(units::range_text(field.min, field.max, field.unit), field.why);
  }
  if (value != 0 && std::abs(value) < field.least) {
    const std::string least = units::format_quantity(field.least, field.unit);
    return with_reason("0, or at least " + least, field.why);
  }
  const units::Range& range = units::range_of(field.unit);
  const double end = std::copysign(range.most, value);
  const std::string text = units::format_quantity(end, field.unit);
  return with_reason((value > 0 ? "at most " : "at least ") + text, range.why);
}

}  // namespace

double atmosphere_of(const Node& root) {
  Reader reader(root);
  double atmosphere = units::atmosphere;
  reader.group({.name = "air", .optional = true}, [&](Reader& air) {
    air.number({.name = "atmosphere", .unit = "Pa abs", .optional = true}, atmosphere);
  });
  return atmosphere;
}

Reader::Reader(const Node& root, ReaderOptions options)
    : options_(std::move(options)), root_(&root) {
  enter(root, "");
}

// --- values ---

void Reader::number(const Field& field, double& value) {
  auto entry = open(field, default_text(value, field.unit), field.unit,
                    number_text(units::describe_unit(field.unit), field));
  if (!entry) return;
  const auto si = si_of(*entry->value, field.unit, entry->origin.path);
  if (si && in_bounds(field, *si, *entry->value, entry->origin.path)) {
    value = *si;
    read_range(field, *entry, value);
  }
  check_uncertainty(field, *entry);
  close(std::move(*entry), true);
}

void Reader::numbers(const Field& field, std::vector<double>& values) {
  auto entry = open(field, joined(values, field.unit), field.unit,
                    "a list, each value " + number_text(units::describe_unit(field.unit), field));
  if (!entry) return;
  if (expect_kind(*entry->value, Node::Kind::array, entry->origin.path)) {
    values.clear();
    for (const Node& item : entry->value->children) {
      const auto si = si_of(item, field.unit, entry->origin.path);
      if (si && in_bounds(field, *si, item, entry->origin.path)) values.push_back(*si);
    }
  }
  close(std::move(*entry), true);
}

void Reader::polynomial(const Field& field, std::vector<double>& coefficients,
                        std::string_view per) {
  auto entry = open(
      field, "", field.unit,
      fmt::format("a list of coefficients, the first in {}", units::describe_unit(field.unit)));
  if (!entry) return;
  if (expect_kind(*entry->value, Node::Kind::array, entry->origin.path)) {
    coefficients.clear();
    for (const Node& item : entry->value->children) {
      const int power = static_cast<int>(coefficients.size());
      const std::string unit = units::coefficient_unit(field.unit, per, power);
      const auto si = si_of(item, unit, entry->origin.path);
      const bool good = si && in_bounds({.unit = unit}, *si, item, entry->origin.path);
      coefficients.push_back(good ? *si : 0);
    }
    if (coefficients.empty()) {
      add_problem(*entry->value, entry->origin.path, "an empty list", "at least one coefficient");
    }
  }
  close(std::move(*entry), true);
}

void Reader::integer(const Field& field, int& value) {
  auto entry = open(field, std::to_string(value), "", number_text("a whole number", field));
  if (!entry) return;
  const Node& node = *entry->value;
  using Limits = std::numeric_limits<int>;
  const double low = std::max<double>(field.min, Limits::min());
  const double high = std::min<double>(field.max, Limits::max());
  const bool whole = node.kind == Node::Kind::integer;
  const double found = whole ? static_cast<double>(node.integer) : node.real;
  // The parser returns a whole number beyond the range of integers as a real number.
  const bool inside = found >= low && found <= high;
  const bool beyond = node.kind == Node::Kind::real && found == std::floor(found) && !inside;
  if (beyond || (whole && !inside)) {
    add_problem(node, entry->origin.path, shown(node), fmt::format("{:.0f} to {:.0f}", low, high));
  } else if (expect_kind(node, Node::Kind::integer, entry->origin.path)) {
    value = static_cast<int>(node.integer);
  }
  close(std::move(*entry), true);
}

void Reader::flag(const Field& field, bool& value) {
  auto entry = open(field, value ? "true" : "false", "", "true or false");
  if (!entry) return;
  if (expect_kind(*entry->value, Node::Kind::flag, entry->origin.path)) value = entry->value->flag;
  close(std::move(*entry), false);
}

void Reader::text(const Field& field, std::string& value) {
  auto entry = open(field, value, "", "a text");
  if (!entry) return;
  if (expect_kind(*entry->value, Node::Kind::text, entry->origin.path)) value = entry->value->text;
  close(std::move(*entry), false);
}

void Reader::texts(const Field& field, std::vector<std::string>& values) {
  const std::vector<std::string_view> defaults(values.begin(), values.end());
  auto entry = open(field, fmt::format("{}", fmt::join(defaults, ", ")), "", "a list of texts");
  if (!entry) return;
  if (expect_kind(*entry->value, Node::Kind::array, entry->origin.path)) {
    values.clear();
    for (const Node& item : entry->value->children) {
      if (expect_kind(item, Node::Kind::text, entry->origin.path)) values.push_back(item.text);
    }
  }
  close(std::move(*entry), false);
}

void Reader::named_numbers(const Field& field, std::map<std::string, double>& values) {
  const Node* table = open_container(field, Node::Kind::table);
  if (!table) return;
  values.clear();
  enter(*table, path_of(field.name));
  for (const Node& child : table->children) {
    if (describes_values(child)) continue;
    Field one = field;
    one.name = child.key;
    number(one, values[child.key]);
  }
  leave();
}

std::optional<std::size_t> Reader::pick(const Field& field,
                                        const std::vector<std::string_view>& words,
                                        std::string_view default_word) {
  auto entry = open(field, std::string(default_word), "", words_text(words));
  if (!entry) return std::nullopt;
  std::optional<std::size_t> index;
  const Node& node = *entry->value;
  const auto it = std::find(words.begin(), words.end(), node.text);
  if (node.kind == Node::Kind::text && it != words.end()) {
    index = static_cast<std::size_t>(it - words.begin());
  } else {
    add_problem(node, entry->origin.path, shown(node), words_text(words),
                closest_in_quotes(node.text, words));
  }
  close(std::move(*entry), false);
  return index;
}

// --- checks of a value ---

bool Reader::expect_kind(const Node& node, Node::Kind kind, const std::string& path) {
  if (node.kind == kind) return true;
  std::string try_this;
  if (kind == Node::Kind::array) try_this = "brackets around it: [ … ]";
  if (kind == Node::Kind::text && !node.is_table() && node.kind != Node::Kind::array) {
    try_this = in_quotes(written(node));
  }
  add_problem(node, path, shown(node), std::string(kind_name(kind)), try_this);
  return false;
}

std::optional<double> Reader::si_of(const Node& node, std::string_view unit,
                                    const std::string& path) {
  std::optional<units::Mistake> mistake;
  if (node.kind == Node::Kind::text) {
    const units::Parsed parsed =
        units::parse_quantity(node.text, unit, options_.atmosphere, node.replaced);
    if (!parsed.mistake) return parsed.si;
    mistake = parsed.mistake;
  } else if (node.is_number()) {
    const double value = node.kind == Node::Kind::real ? node.real : double(node.integer);
    if (!std::isfinite(value)) {
      mistake = units::Mistake{written(node), units::describe_finite(unit), ""};
    } else if (unit == "1") {
      return value;
    } else {
      mistake = units::missing_unit(written(node), unit, node.replaced);
    }
  } else {
    mistake = units::Mistake{shown(node), units::describe_unit(unit), ""};
  }
  add_problem(node, path, mistake->found, mistake->expected, mistake->try_this);
  return std::nullopt;
}

bool Reader::in_bounds(const Field& field, double value, const Node& node,
                       const std::string& path) {
  std::string expected = out_of_bounds(field, value);
  if (expected.empty()) return true;
  std::string found = shown(node);
  const std::string unit(field.unit.empty() ? "1" : field.unit);
  const std::string si = units::format_quantity(value, unit, unit);
  if (written(node) != si) found += ", which is " + si;
  add_problem(node, path, std::move(found), std::move(expected));
  return false;
}

// --- node and provenance of a field ---

std::string Reader::path_of(std::string_view key) const {
  const std::string& path = scopes_.back().path;
  return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
}

const Node* Reader::find_field(const Field& field) {
  const Node* table = scopes_.back().table;
  requested_[table].emplace_back(field.name);
  const Node* node = table->find(field.name);
  if (node) node->used = true;
  return node;
}

std::optional<Reader::Entry> Reader::open(const Field& field, std::string default_text,
                                          std::string_view unit, const std::string& expected) {
  const Node* node = find_field(field);
  Entry entry{node, {}, scopes_.back().range, false};
  entry.origin.path = path_of(field.name);
  entry.origin.unit = unit;
  if (!node) {
    if (field.optional || options_.of_a_log) {
      entry.origin.text = std::move(default_text);
      entry.origin.is_default = true;
      origins_.push_back(std::move(entry.origin));
    } else {
      add_problem(*scopes_.back().table, entry.origin.path, "nothing",
                  with_reason(expected, field.doc));
    }
    return std::nullopt;
  }
  entry.origin.where = node->where;
  if (node->is_value_table()) read_value_table(*node, entry);
  add_provenance(*node, entry);
  entry.origin.text = written(*entry.value);
  return entry;
}

// --- tables ---

const Node* Reader::open_container(const Field& field, Node::Kind kind) {
  const Node* node = find_field(field);
  const std::string path = path_of(field.name);
  if (!node) {
    if (!field.optional && !options_.of_a_log) {
      add_problem(*scopes_.back().table, path, "nothing", std::string(kind_name(kind)),
                  fmt::format("[{}]", path));
    }
    return nullptr;
  }
  return expect_kind(*node, kind, path) ? node : nullptr;
}

void Reader::enter(const Node& table, const std::string& path) {
  Scope scope = scopes_.empty() ? Scope{} : scopes_.back();
  scope.table = &table;
  scope.path = path;
  scope.range = described(table, "range");
  if (const Node* source = described(table, "source")) scope.source = source;
  if (const Node* fit = described(table, "fit")) scope.fit = fit;
  if (const Node* guess = described(table, "guess")) scope.guess = guess;
  scopes_.push_back(std::move(scope));
}

// Returns the tables in a table of named tables, or in a list.
std::vector<const Node*> Reader::tables_in(const Node& container) {
  std::vector<const Node*> tables;
  for (const Node& child : container.children) {
    child.used = true;
    if (child.is_table()) {
      tables.push_back(&child);
    } else if (!describes_values(child)) {
      expect_kind(child, Node::Kind::table, path_of(child.key));
    }
  }
  return tables;
}

// --- unused keys ---

void Reader::refuse_unused(const Node& child, const std::string& path,
                           const std::vector<std::string_view>& known) {
  const std::string expected =
      known.empty() || known.size() > 12 ? "a key that is read here" : either(known);
  if (const KeyChange* removed = removed_key(path, *options_.changes))
    return add_problem(child, path, "a key that is gone", expected,
                       replacement_text(*removed, path));
  add_problem(child, path, "an unknown key", expected, std::string(closest(child.key, known)));
}

void Reader::find_unused(const Node& table, const std::string& path) {
  const auto requested = requested_.find(&table);
  std::vector<std::string_view> known;
  if (requested != requested_.end())
    known.assign(requested->second.begin(), requested->second.end());
  std::sort(known.begin(), known.end());
  known.erase(std::unique(known.begin(), known.end()), known.end());

  const bool list = table.kind == Node::Kind::array;
  int index = 0;
  for (const Node& child : table.children) {
    std::string child_path = path;
    if (list) {
      child_path += fmt::format("[{}]", index++);
    } else {
      child_path += (path.empty() ? "" : ".") + child.key;
    }
    if (child.used) {
      find_unused(child, child_path);
    } else if (!list && !describes_values(child)) {
      refuse_unused(child, child_path, known);
    }
  }
}

void Reader::finish() {
  find_unused(*root_, "");
  finish_part();
}

void Reader::finish_part() {
  if (!problems_.empty()) throw Error(problems_);
}

void Reader::report_conflict(std::string_view key, std::string found, std::string expected,
                             std::string try_this) {
  if (options_.of_a_log) return;
  const Node& table = *scopes_.back().table;
  const Node* node = table.find(key);
  add_problem(node ? *node : table, path_of(key), std::move(found), std::move(expected),
              std::move(try_this));
}

void Reader::add_problem(const Node& at, std::string path, std::string found, std::string expected,
                         std::string try_this) {
  problems_.push_back(
      {at.where, std::move(path), std::move(found), std::move(expected), std::move(try_this)});
}

// --- provenance of a value: source, fit, guess, range, uncertainty ---

const Origin* find_origin(const Origins& origins, std::string_view path) {
  const auto it = std::find_if(origins.begin(), origins.end(),
                               [&](const Origin& origin) { return origin.path == path; });
  return it == origins.end() ? nullptr : &*it;
}

bool Reader::describes_values(const Node& node) {
  if (node.key == "source") return node.kind == Node::Kind::text;
  if (node.key == "fit" || node.key == "guess") return node.kind == Node::Kind::flag;
  return node.key == "range" && node.kind == Node::Kind::array;
}

const Node* Reader::described(const Node& table, std::string_view key) {
  const Node* node = table.find(key);
  return node && describes_values(*node) ? node : nullptr;
}

void Reader::read_value_table(const Node& table, Entry& entry) {
  for (const char* key : {"value", "source", "fit", "guess", "range", "uncertainty"}) {
    requested_[&table].emplace_back(key);
    const Node* node = table.find(key);
    if (node && (node->key == "value" || node->key == "uncertainty" || describes_values(*node))) {
      node->used = true;
    }
  }
  entry.value = table.find("value");
  if (const Node* range = described(table, "range")) {
    entry.range = range;
    entry.own_range = true;
  }
  if (const Node* uncertainty = table.find("uncertainty")) {
    entry.origin.uncertainty = written(*uncertainty);
  }
}

// The value's own provenance takes precedence over that of the enclosing tables.
void Reader::add_provenance(const Node& table, Entry& entry) {
  const Scope& scope = scopes_.back();
  Origin& origin = entry.origin;
  const bool own_table = entry.value != &table;
  const Node* source = own_table ? described(table, "source") : nullptr;
  const Node* fit = own_table ? described(table, "fit") : nullptr;
  const Node* guess = own_table ? described(table, "guess") : nullptr;
  const bool silent = !source && !fit && !guess;

  // Enclosing tables apply only to values of the same file, not to those of --set or a derived
  // file.
  const auto covering = [&table](const Node* node) {
    return node && node->where.file == table.where.file ? node : nullptr;
  };
  if (!source) source = covering(scope.source);
  if (silent) {
    fit = covering(scope.fit);
    guess = covering(scope.guess);
  }
  if (source) origin.source = source->text;
  if (!source && table.where.file == "--set") origin.source = "--set";
  origin.fit = fit && fit->flag;
  origin.guess = guess && guess->flag;
  if (origin.fit && origin.guess) {
    add_problem(table, origin.path, "both fit and guess", "one of them");
  }
}

void Reader::close(Entry entry, bool numeric) {
  if (numeric) check_source(entry.origin);
  origins_.push_back(std::move(entry.origin));
}

void Reader::check_source(const Origin& origin) {
  if (!origin.source.empty()) return;
  const bool needed = options_.needs_source && options_.needs_source(origin.where.file);
  auto& list = needed ? problems_ : unsourced_;
  list.push_back({origin.where, origin.path, in_quotes(origin.text) + " without a source",
                  "where the value comes from",
                  fmt::format("{{ value = {}, source = \"…\" }}", in_quotes(origin.text))});
}

// Reads the range given in the file: information for fitting, and a warning if the value is
// outside.
void Reader::read_range(const Field& field, Entry& entry, double value) {
  if (!entry.range) return;
  const auto& ends = entry.range->children;
  std::array<double, 2> range{};
  for (std::size_t i = 0; i < 2 && ends.size() == 2; ++i) {
    // A table's range applies only to quantities with its unit.
    const units::Parsed quiet =
        units::parse_quantity(written(ends[i]), field.unit, options_.atmosphere);
    if (quiet.mistake && !entry.own_range) return;
    const auto end = si_of(ends[i], field.unit, entry.origin.path + ".range");
    if (!end) return;
    range[i] = *end;
  }
  if (ends.size() != 2 || range[0] > range[1]) {
    return add_problem(*entry.range, entry.origin.path + ".range", written(*entry.range),
                       "two quantities, the lower one first");
  }
  for (const Node& end : ends) entry.origin.range.push_back(written(end));
  entry.origin.range_si = range;
  if (value >= range[0] && value <= range[1]) return;
  warnings_.push_back({entry.origin.where, entry.origin.path, shown(*entry.value),
                       fmt::format("a value in its own range {} to {}", entry.origin.range[0],
                                   entry.origin.range[1]),
                       "a wider range, or check the fit"});
}

void Reader::check_uncertainty(const Field& field, const Entry& entry) {
  const std::string& text = entry.origin.uncertainty;
  if (text.empty() || !units::parse_quantity(text, "1").mistake) return;  // a share: "5 %"
  const std::string_view unit = units::difference_unit(field.unit);
  if (const auto mistake = units::parse_quantity(text, unit).mistake) {
    add_problem(*entry.value, entry.origin.path + ".uncertainty", mistake->found,
                mistake->expected + ", or %", mistake->try_this);
  }
}

}  // namespace sinew::config
