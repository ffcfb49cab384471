// The inputs of a method as text: units, what is needed, JSON, and a CSV to fill in.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "sinew/config/diagnostics.h"
#include "sinew/config/quantity.h"
#include "sinew/config/setting.h"
#include "sinew/identify/task/inputs.h"
#include "sinew/json/json.h"
#include "sinew/units/unit.h"

namespace sinew::identify {

namespace {

// Of quantities that are made of others, the units that instruments print.
constexpr std::string_view compound_units[] = {"L/min", "L/s", "g/s",    "g/min",
                                               "deg/s", "N m", "lbf in", "lbf ft"};

// A pressure says what it is counted from; one from the room and one from nothing are read alike.
std::vector<std::string> pressure_references(std::string_view unit) {
  if (unit.ends_with(" gauge")) return {" gauge", " abs"};
  if (unit.ends_with(" abs")) return {" abs", " gauge"};
  return {""};
}

units::Dimension dimension_of_column(std::string_view unit) {
  for (const std::string_view word : {" gauge", " abs"})
    if (unit.ends_with(word)) unit.remove_suffix(word.size());
  return units::read_unit(unit).unit.dimension;
}

// The columns between bars: "force|load".
std::vector<std::string> alternatives_in(const std::string& group) {
  std::vector<std::string> out{""};
  for (const char c : group) {
    if (c == '|')
      out.emplace_back();
    else
      out.back() += c;
  }
  return out;
}

// The group in which a kind of table needs the column; empty: it does not.
std::vector<std::string> needed_group_of(const TableKind& kind, std::string_view column) {
  for (const std::string& group : config::at_commas(std::string(kind.needed))) {
    const std::vector<std::string> names = alternatives_in(group);
    if (std::ranges::find(names, column) != names.end()) return names;
  }
  return {};
}

const TableKind& table_kind_called(const MethodInputs& inputs, std::string_view name) {
  if (name.empty()) return inputs.kinds.front();
  const std::vector<std::string_view> names = config::names_of(inputs.kinds);
  for (const TableKind& kind : inputs.kinds)
    if (kind.name == name) return kind;
  config::fail({"kind", 0, 0}, "", config::in_quotes(name),
               inputs.kinds.size() == 1
                   ? fmt::format("none: {} takes one kind of table", inputs.method)
                   : config::either(names),
               config::closest_in_quotes(name, names));
}

Json json_of_column(const MethodInputs& inputs, const Wanted& w) {
  Json out{{"name", w.name},
           {"quantity", quantity_of(w)},
           {"si_unit", w.unit},
           {"units", accepted_units(w)},
           {"needed", need_of(inputs, w.name)},
           {"meaning", w.doc}};
  if (w.most > 0) out["largest_value"] = {{"least", w.least}, {"most", w.most}};
  for (const auto& [word, value] : w.words) out["words"].push_back(word);
  return out;
}

// Returns the name of a header's "length [mm]".
std::string name_in_heading(const std::string& heading) {
  return heading.substr(0, std::min(heading.find(" ["), heading.size()));
}

}  // namespace

std::vector<std::string> accepted_units(const Wanted& w) {
  std::vector<std::string> out;
  if (!w.words.empty()) return out;
  const units::Dimension dimension = dimension_of_column(w.unit);
  const auto add = [&](std::string_view unit) {
    const std::string name(unit);
    if (std::ranges::find(out, name) == out.end()) out.push_back(name);
  };
  if (w.unit == "1") add("1");
  for (const std::string& reference : pressure_references(w.unit))
    for (const units::Unit& u : units::known_units)
      if (u.dimension == dimension) add(std::string(u.name) + reference);
  for (const std::string_view unit : compound_units)
    if (dimension_of_column(unit) == dimension) add(unit);
  for (const std::string& unit : config::usual_units(w.unit)) add(unit);
  return out;
}

std::string quantity_of(const Wanted& w) {
  if (!w.words.empty()) return "word";
  if (w.unit == "1") return "number";
  if (w.unit == "m3/s") return "volume flow";
  if (w.unit == "kg/s") return "mass flow";
  for (const units::DimensionName& name : units::dimension_names)
    if (name.dimension == dimension_of_column(w.unit)) return std::string(name.word);
  return std::string(w.unit);
}

std::string need_of(const MethodInputs& inputs, std::string_view column) {
  // What may stand in its place, and the kinds of table for which that holds.
  std::vector<std::pair<std::string, std::vector<std::string_view>>> parts;
  for (const TableKind& kind : inputs.kinds) {
    std::vector<std::string> others = needed_group_of(kind, column);
    if (others.empty()) continue;
    std::erase(others, column);
    const std::string instead =
        others.empty() ? "" : fmt::format(", or {}", fmt::join(others, " or "));
    if (parts.empty() || parts.back().first != instead) parts.push_back({instead, {}});
    parts.back().second.push_back(kind.name);
  }
  if (parts.empty()) return "optional";
  if (parts.front().second.size() == inputs.kinds.size()) return "required" + parts.front().first;
  std::string out = "required";
  for (const auto& [instead, kinds] : parts)
    out +=
        fmt::format("{} for {}{}", out == "required" ? "" : ";", fmt::join(kinds, ", "), instead);
  return out;
}

Json to_json(const MethodInputs& inputs) {
  Json out{{"format", "sinew.columns/1"}, {"method", inputs.method}};
  out["columns"] = Json::array();
  for (const Wanted& w : inputs.columns()) out["columns"].push_back(json_of_column(inputs, w));
  for (const TableKind& kind : inputs.kinds) {
    Json one{{"row", kind.row}};
    if (!kind.name.empty()) one["name"] = kind.name;
    for (const std::string& group : config::at_commas(std::string(kind.needed)))
      one["needed"].push_back(alternatives_in(group));
    one["header"] = kind.header;
    out["tables"].push_back(one);
  }
  out["advice"] = inputs.advice;
  return out;
}

std::string template_of(const MethodInputs& inputs, std::string_view kind_name) {
  const TableKind& kind = table_kind_called(inputs, kind_name);
  std::string out = fmt::format(
      "# For `sinew identify {}`. A row is {}.\n"
      "# Units may be changed here; the rows are examples: put yours in their place.\n",
      inputs.method, kind.row);
  const std::vector<Wanted> columns = inputs.columns();
  for (const std::string& heading : config::at_commas(std::string(kind.header))) {
    const std::string name = name_in_heading(heading);
    const auto wanted = std::ranges::find(columns, name, &Wanted::name);
    const bool known = wanted != columns.end();
    out += fmt::format("# {}: {} ({})\n", name, known ? wanted->doc : "of a sensor",
                       known ? need_of(inputs, name) : "name it as you like");
  }
  return out + fmt::format("{}\n{}", kind.header, kind.rows);
}

}  // namespace sinew::identify
