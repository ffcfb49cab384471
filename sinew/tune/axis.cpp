#include "sinew/tune/axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/config/changes.h"
#include "sinew/units/quantity.h"

namespace sinew::tune {
namespace {

constexpr double most_values = 10000;

// Returns a number with its unit, "0.05 %/count"; nullopt for a word such as "2-way".
std::optional<units::NumberAndUnit> number_in(std::string_view text) {
  const units::NumberAndUnit out = units::split_number(text);
  if (out.error != std::errc{} || !std::isfinite(out.number)) return std::nullopt;
  const bool is_unit = out.unit.empty() || out.unit.data()[-1] == ' ' || out.unit[0] == '%' ||
                       (out.unit[0] | 32) >= 'a';
  return is_unit ? std::optional(out) : std::nullopt;
}

// Rounds to 12 digits, which removes the errors of steps: 0.30000000000000004 is 0.3.
double rounded(double number) { return units::with_digits(number, 12); }

// A whole number without a unit has all its digits: a key that takes whole numbers reads no 1e+09.
Value number_value(double number, std::string_view unit) {
  const bool is_whole = unit.empty() && number == std::floor(number) && std::fabs(number) < 1e15;
  const std::string cell = is_whole ? fmt::format("{:.0f}", number) : units::format_number(number);
  return {unit.empty() ? cell : fmt::format("{} {}", cell, unit), cell, number};
}

// Adds a list of values. Numbers share one unit, that of the last, or of those that have one.
void add_list(Axis& axis, const std::vector<std::string_view>& items, std::string_view text,
              std::string_view setting) {
  std::vector<std::optional<units::NumberAndUnit>> numbers;
  for (const std::string_view item : items) {
    if (item.empty()) refuse(setting, text, "a value between two commas");
    numbers.push_back(number_in(item));
    if (!numbers.back() || numbers.back()->unit.empty()) continue;
    if (!axis.unit.empty() && axis.unit != numbers.back()->unit)
      refuse(setting, text, "one unit for all values", "the same words for it: " + axis.unit);
    axis.unit = numbers.back()->unit;
  }
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::string word(items[i]);
    axis.values.push_back(numbers[i] ? number_value(numbers[i]->number, axis.unit)
                                     : Value{word, word, std::nullopt});
  }
}

// Expected form of numbers between colons, for errors.
struct Form {
  std::string_view setting;
  std::size_t parts = 0;
  std::string_view words;  // "from:to:how many"
  std::string example;
};

// Returns the numbers between colons, of which the first two must differ; each may have the unit.
std::vector<double> between_colons(Axis& axis, std::string_view text, const Form& form) {
  std::vector<double> out;
  for (std::string_view rest = text;;) {
    const std::size_t colon = rest.find(':');
    const auto part = number_in(trimmed(rest.substr(0, colon)));
    if (!part) refuse(form.setting, text, std::string(form.words), form.example);
    if (!part->unit.empty() && !axis.unit.empty() && axis.unit != part->unit)
      refuse(form.setting, text, "one unit", form.example);
    if (!part->unit.empty()) axis.unit = part->unit;
    out.push_back(part->number);
    if (colon == rest.npos) break;
    rest.remove_prefix(colon + 1);
  }
  if (out.size() != form.parts) refuse(form.setting, text, std::string(form.words), form.example);
  return out;
}

void refuse_equal_ends(const std::vector<double>& ends, std::string_view text, const Form& form) {
  if (ends[0] == ends[1]) refuse(form.setting, text, "two different ends", form.example);
}

void add_range(Axis& axis, std::string_view text, std::string_view setting) {
  const std::string_view last = trimmed(text.substr(text.rfind(':') + 1));
  const auto number = number_in(last);
  const std::string_view unit =
      number ? number->unit : last.substr(std::min(last.find(' '), last.size()));
  const std::string example = fmt::format("{}=0:1:5 {}", axis.key, trimmed(unit));
  const Form form{setting, 3, "from:to:how many", config::in_quotes(trimmed(example))};
  const std::vector<double> parts = between_colons(axis, text, form);
  const double from = parts[0], to = parts[1], n = parts[2];
  if (n != std::floor(n) || n < 2 || n > most_values)
    refuse(setting, text, "2 to 10000 values: from:to:how many", form.example);
  refuse_equal_ends(parts, text, form);
  for (double i = 0; i < n; ++i)
    axis.values.push_back(number_value(rounded(from + i * (to - from) / (n - 1)), axis.unit));
}

void add_places(const config::Node& node, const std::string& key, Places& out) {
  if (node.kind == config::Node::Kind::table || node.kind == config::Node::Kind::array) {
    for (const config::Node& child : node.children)
      add_places(child, child.key.empty() ? key : child.key, out);
  } else {
    // A plan's reader replaces old keys by present ones, and its texts are searched here.
    out.try_emplace({key, config::with_present_key(config::written(node))}, node.where);
  }
}

}  // namespace

Places places_of(const config::Node& root) {
  Places out;
  add_places(root, "", out);
  return out;
}

std::string place_of(const Places& places, const std::string& key, const std::string& text) {
  const auto found = places.find({key, text});
  if (found == places.end()) return key;
  const config::Location& at = found->second;
  return fmt::format("{}:{}:{}: {}", at.file, at.line, at.column, key);
}

std::vector<std::string_view> list_of(std::string_view text) {
  std::vector<std::string_view> out;
  std::size_t start = 0;
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i <= text.size(); ++i) {
    const char c = i < text.size() ? text[i] : ',';
    if (c == '"') quoted = !quoted;
    if (!quoted && (c == '[' || c == '{')) ++depth;
    if (!quoted && (c == ']' || c == '}')) --depth;
    const bool ends = i == text.size() || (c == ',' && depth <= 0 && !quoted);
    if (!ends) continue;
    out.push_back(trimmed(text.substr(start, i - start)));
    start = i + 1;
  }
  return out;
}

std::string Axis::heading() const { return unit.empty() ? key : fmt::format("{} [{}]", key, unit); }

Value Axis::at(double number) const { return number_value(rounded(number), unit); }

std::string Axis::set(const Value& value) const { return key + "=" + value.text; }

Axis parse_axis(std::string_view text, std::string_view setting) {
  const std::size_t equals = text.find('=');
  Axis axis{.key = std::string(trimmed(text.substr(0, equals))),
            .unit = {},
            .values = {},
            .setting = std::string(setting)};
  if (equals == text.npos || axis.key.empty() || trimmed(text.substr(equals + 1)).empty())
    refuse(setting, text, "KEY=a,b,c or KEY=from:to:how many, and the unit",
           "\"joint.hip.angle_gain=0.02:0.1:5 %/count\"");
  const std::string_view values = trimmed(text.substr(equals + 1));
  const std::vector<std::string_view> items = list_of(values);
  const bool range = items.size() == 1 && values.find(':') != values.npos &&
                     number_in(trimmed(values.substr(0, values.find(':'))));
  if (range) {
    add_range(axis, values, setting);
  } else {
    add_list(axis, items, text, setting);
  }
  return axis;
}

Axis parse_ends(std::string_view text, std::string_view setting, const std::string& example) {
  const std::size_t equals = text.find('=');
  Axis axis{.key = std::string(trimmed(text.substr(0, equals))),
            .unit = {},
            .values = {},
            .setting = std::string(setting)};
  const Form form{setting, 2, "KEY=from:to and the unit", example};
  if (equals == text.npos || axis.key.empty())
    refuse(setting, text, std::string(form.words), example);
  const std::string_view ends = trimmed(text.substr(equals + 1));
  const std::vector<double> numbers = between_colons(axis, ends, form);
  if (!(numbers[0] < numbers[1])) refuse(setting, text, "a low end below the high end", example);
  for (const double number : numbers) axis.values.push_back(number_value(number, axis.unit));
  return axis;
}

Axis seeds(int n, std::string setting) {
  Axis axis{.key = "seed", .unit = {}, .values = {}, .setting = std::move(setting)};
  for (int i = 1; i <= n; ++i) axis.values.push_back(axis.at(i));
  return axis;
}

std::size_t Grid::size() const {
  std::size_t n = 1;
  for (const Axis& axis : *axes_) n *= axis.values.size();
  return n;
}

std::vector<const Value*> Grid::point(std::size_t index) const {
  std::vector<const Value*> out(axes_->size());
  for (std::size_t i = axes_->size(); i-- > 0;) {
    const std::vector<Value>& values = (*axes_)[i].values;
    out[i] = &values[index % values.size()];
    index /= values.size();
  }
  return out;
}

}  // namespace sinew::tune
