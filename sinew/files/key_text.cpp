#include "sinew/files/key_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "sinew/config/diagnostics.h"
#include "sinew/json/json.h"
#include "sinew/report/text/text_table.h"
#include "sinew/units/quantity.h"

namespace sinew::files {

namespace {

// A kind of file: its title, the usual path of its files, and a note about keys that a file of that
// kind has in other files.
struct Kind {
  std::string_view name, title, files, note = "";
};
constexpr Kind titled_kinds[] = {
    {"any", "Every file", "",
     "source, fit, guess and range are keys of { value = … }, or of a table for all its values."},
    {"robot", "Robot", "robots/*/robot.toml",
     "Actuators and valves can be in this file or in files of their own."},
    {"actuator", "Actuator", "robots/*/actuator.toml",
     "In an actuator file the keys omit actuator.<name>: [braid], not [actuator.bpa.braid]."},
    {"valves", "Valves", "robots/*/valves.toml"},
    {"wiring", "Wiring", "robots/*/wiring.toml"},
    {"experiment", "Experiment", "experiments/*.toml",
     "An experiment may change every key of its robot, its actuators, valves and wiring."},
    {"rig", "Rig, the test stand of one muscle", "experiments/rig/*.toml",
     "Actuators and valves can be in this file or in files of their own."},
    {"plan", "Plan of a sweep or a sensitivity", "studies/*.toml"},
    {"tuning", "Tuning", "studies/*.toml"},
    {"mapping", "Mapping of a recording's columns", "*.toml"},
    {"settings", "Settings of a user", "~/.config/sinew/settings.toml"},
};

bool is_container(const Key& key) {
  return key.type == KeyType::table || key.type == KeyType::tables || key.type == KeyType::list;
}

// Returns the range, which includes the unit; "number" if there is no unit.
std::string quantity_text(const Key& key) {
  const std::string range = range_of(key);
  if (key.unit == "1") return range.empty() ? "number" : "number, " + range;
  return range.empty() ? key.unit : range;
}

std::string polynomial_text(const Key& key) {
  const std::string unit = key.unit == "1" ? "number" : key.unit;
  return fmt::format("list: {}, then per {}", unit, key.per == "1" ? "one" : key.per);
}

std::string holds(const Key& key) {
  constexpr std::string_view words[] = {
      "number",        "list of numbers", "list",  "whole number",   "true, false",    "text",
      "list of texts", "a word",          "table", "tables by name", "list of tables", ""};
  if (key.type == KeyType::number) return quantity_text(key);
  if (key.type == KeyType::numbers) return "list: " + quantity_text(key);
  if (key.type == KeyType::polynomial) return polynomial_text(key);
  const std::string word(words[static_cast<std::size_t>(key.type)]), range = range_of(key);
  return key.type == KeyType::whole && !range.empty() ? word + ", " + range : word;
}

std::string stands_instead(const Key& key) {
  if (key.required) return "required";
  return key.default_text;
}

std::vector<std::string> quoted(const std::vector<std::string>& words) {
  std::vector<std::string> out;
  for (const std::string& word : words) out.push_back(fmt::format("\"{}\"", word));
  return out;
}

// Returns the description of a key, with its choices and condition.
std::string line_of(const Key& key) {
  std::string out = key.doc;
  if (!key.choices.empty()) {
    const std::vector<std::string> words = quoted(key.choices);
    out += (out.empty() ? "" : "; ") + config::either({words.begin(), words.end()});
  }
  if (!key.when.empty()) out += (out.empty() ? "" : "; ") + ("where " + key.when);
  return out;
}

Json to_json(const Key& key) {
  Json out{{"kind", key.kind}, {"key", key.path}, {"type", to_text(key.type)}};
  if (!key.unit.empty()) {
    out["unit"] = key.unit;
    if (key.unit != "1") out["written"] = units::usual_units(key.unit);
  }
  if (!key.per.empty()) out["per"] = key.per;
  if (std::isfinite(key.min)) out["min"] = key.min;
  if (std::isfinite(key.max)) out["max"] = key.max;
  if (key.least > 0) out["least"] = key.least;
  if (std::isfinite(key.most)) out["most"] = key.most;
  if (!key.why.empty()) out["why"] = key.why;
  out["required"] = key.required;
  if (!key.required && !is_container(key)) out["default"] = key.default_text;
  if (!key.choices.empty()) out["choices"] = key.choices;
  if (!key.when.empty()) out["when"] = key.when;
  out["doc"] = key.doc;
  return out;
}

// Returns a Markdown cell, with escapes for bars and for names in angle brackets.
std::string cell(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '|' || c == '*') out += '\\';
    if (c == '<')
      out += "&lt;";
    else
      out += c;
  }
  return out;
}

}  // namespace

std::string overview_of_keys(std::size_t width) {
  report::TextTable table({"kind", "keys and tables at the top"});
  for (const std::string& kind : key_kinds()) {
    std::vector<std::string> tops;
    for (const Key& key : keys_of(kind))
      if (key.path.find('.') == std::string::npos) tops.push_back(key.path);
    const auto last = std::unique(tops.begin(), tops.end());
    tops.erase(last, tops.end());
    table.add({kind, fmt::format("{}", fmt::join(tops, " "))});
  }
  return table.text_within(width);
}

std::string text_of(const std::vector<Key>& keys, std::size_t width) {
  std::string out;
  for (const std::string& kind : key_kinds()) {
    report::TextTable table({"key", "holds", "default", "what it is"});
    for (const Key& key : keys)
      if (key.kind == kind) table.add({key.path, holds(key), stands_instead(key), line_of(key)});
    if (table.empty()) continue;
    const Kind& its = *std::ranges::find(titled_kinds, kind, &Kind::name);
    out += fmt::format("{}{}{}{}\n", out.empty() ? "" : "\n", its.title,
                       its.files.empty() ? "" : ": ", its.files);
    out += table.text_within(width);
    if (!its.note.empty()) out += fmt::format("{}\n", its.note);
  }
  return out;
}

std::string json_of(const std::vector<Key>& keys) { return Json::array(keys, to_json).text(); }

std::string page_of_keys() {
  std::string out =
      "# Every key of every file\n\n"
      "`sinew keys WORD` finds keys in a terminal, `sinew.keys(\"damping\")` in Python, "
      "`files::find_keys` in C++; `sinew keys` also writes a JSON schema of each kind of file, by "
      "which editors complete and check. Units are SI; a file may use any other unit of the same "
      "quantity (`\"3.2 in\"`, `\"60 psi gauge\"`). `<name>` is a name that you choose, `[]` a "
      "list "
      "of tables. [59] is an equation of the thesis; B.1, appendix A and thesis 6.5 are sections. "
      "The program generates this page from the tables with which it reads files.\n";
  for (const std::string& kind : key_kinds()) {
    const Kind& its = *std::ranges::find(titled_kinds, kind, &Kind::name);
    out += fmt::format("\n## {}\n\n", its.title);
    const std::string note = cell(its.note);
    if (!its.files.empty()) out += fmt::format("`{}`.{}", its.files, note.empty() ? "" : " ");
    out += note + "\n\n";
    out += "| key | holds | default | what it is |\n| --- | --- | --- | --- |\n";
    for (const Key& key : keys_of(kind))
      out += fmt::format("| `{}` | {} | {} | {} |\n", key.path, cell(holds(key)),
                         cell(stands_instead(key)), cell(line_of(key)));
  }
  return out;
}

}  // namespace sinew::files
