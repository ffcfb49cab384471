// What a reader finds out about a value beside the value: source, fit, guess, range, uncertainty.
#include <fmt/format.h>

#include <algorithm>

#include "sinew/config/quantity.h"
#include "sinew/config/reader.h"

namespace sinew::config {

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
    asked_[&table].emplace_back(key);
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

// The value's own words first, then those of the tables around it.
void Reader::add_provenance(const Node& table, Entry& entry) {
  const Scope& scope = scopes_.back();
  Origin& origin = entry.origin;
  const bool own_table = entry.value != &table;
  const Node* source = own_table ? described(table, "source") : nullptr;
  const Node* fit = own_table ? described(table, "fit") : nullptr;
  const Node* guess = own_table ? described(table, "guess") : nullptr;
  const bool silent = !source && !fit && !guess;

  // The tables around speak for their own file only: --set and a derived file speak for themselves.
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

// The range the file itself gives: information for fitting, and a warning where the value left it.
void Reader::read_range(const Field& field, Entry& entry, double value) {
  if (!entry.range) return;
  const auto& ends = entry.range->children;
  std::array<double, 2> range{};
  for (std::size_t i = 0; i < 2 && ends.size() == 2; ++i) {
    // A table's range covers only what has its unit.
    const Parsed quiet = parse_quantity(written(ends[i]), field.unit, options_.atmosphere);
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
                       "a wider range, or a look at the fit"});
}

void Reader::check_uncertainty(const Field& field, const Entry& entry) {
  const std::string& text = entry.origin.uncertainty;
  if (text.empty() || !parse_quantity(text, "1").mistake) return;  // a share: "5 %"
  const std::string_view unit = difference_unit(field.unit);
  if (const auto mistake = parse_quantity(text, unit).mistake) {
    add_problem(*entry.value, entry.origin.path + ".uncertainty", mistake->found,
                mistake->expected + ", or %", mistake->try_this);
  }
}

}  // namespace sinew::config
