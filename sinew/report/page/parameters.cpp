#include "sinew/report/page/parameters.h"

#include <algorithm>
#include <map>

#include "sinew/units/quantity.h"

namespace sinew::report {

namespace {

using config::Node;

bool is_flag(const Node& table, std::string_view key) {
  const Node* flag = table.find(key);
  return flag && flag->kind == Node::Kind::flag && flag->flag;
}

std::string text_of(const Node& table, std::string_view key) {
  const Node* node = table.find(key);
  return node ? config::written(*node) : "";
}

std::string range_of(const Node& table) {
  const Node* range = table.find("range");
  if (!range || range->children.size() != 2) return "";
  return config::written(range->children[0]) + " to " + config::written(range->children[1]);
}

Parameter parameter(const Node& node, std::string key) {
  if (!node.is_value_table()) return {.key = std::move(key), .value = config::written(node)};
  Parameter out{.key = std::move(key), .value = text_of(node, "value")};
  out.source = text_of(node, "source");
  out.mark = is_flag(node, "fit") ? "fit" : is_flag(node, "guess") ? "guess" : "";
  if (out.source == "default") {
    out.mark = "default";
    out.source.clear();
  }
  out.range = range_of(node);
  out.uncertainty = text_of(node, "uncertainty");
  return out;
}

bool is_list_of_tables(const Node& node) {
  return node.kind == Node::Kind::array && !node.children.empty() &&
         node.children.front().is_table();
}

// Appends the values of a table. The table's source is used for values without a source.
void collect(const Node& table, const std::string& path, std::vector<Parameter>& out) {
  const std::string source = text_of(table, "source");
  for (const Node& child : table.children) {
    const std::string key = path.empty() ? child.key : path + "." + child.key;
    if (key == "reported" || key == "format" || child.key == "source") continue;
    if (child.is_table() && !child.is_value_table()) {
      collect(child, key, out);
      continue;
    }
    if (is_list_of_tables(child)) {
      for (std::size_t i = 0; i < child.children.size(); ++i)
        collect(child.children[i], key + "[" + std::to_string(i) + "]", out);
      continue;
    }
    Parameter row = parameter(child, key);
    if (row.source.empty() && row.mark.empty()) row.source = source;
    if (!row.value.empty()) out.push_back(std::move(row));
  }
}

std::optional<PageChange> change_of(const config::Node& table) {
  const std::string at = value_text(table, "time"), to = value_text(table, "value");
  const units::NumberAndUnit time = units::split_number(at);
  PageChange out{.key = value_text(table, "key"), .unit = "", .leg = value_text(table, "leg")};
  if (time.unit != "s" || out.key.empty()) return std::nullopt;
  out.time = time.number;
  out.release = value_text(table, "release") == "true";
  if (out.release) return out;
  const units::NumberAndUnit value = units::split_number(to);
  if (value.error != std::errc{}) return std::nullopt;
  out.value = value.number;
  out.unit = units::written_unit(to);
  return out;
}

}  // namespace

std::string value_text(const Node& table, std::string_view key) {
  const Node* node = table.find(key);
  if (!node) return "";
  const Node* value = node->find("value");
  return config::written(value ? *value : *node);
}

std::vector<Parameter> parameters(const Node& resolved) {
  std::vector<Parameter> out;
  collect(resolved, "", out);
  return out;
}

std::vector<ParameterRow> differing(const std::vector<const std::vector<Parameter>*>& runs) {
  std::vector<ParameterRow> rows;
  std::map<std::string_view, std::size_t> row_of;
  for (std::size_t run = 0; run < runs.size(); ++run)
    for (const Parameter& p : *runs[run]) {
      const auto [at, is_new] = row_of.try_emplace(p.key, rows.size());
      if (is_new) rows.push_back({p.key, std::vector<std::optional<std::string>>(runs.size())});
      rows[at->second].values[run] = p.value;
    }
  std::erase_if(rows, [](const ParameterRow& row) {
    // The files of a recording are no parameters of the machine.
    return row.key == "title" || row.key == "reproduces" || row.key.starts_with("imported[") ||
           std::ranges::all_of(row.values, [&](const auto& v) { return v == row.values.front(); });
  });
  return rows;
}

std::vector<PageChange> changes_of(const config::Node& resolved) {
  std::vector<PageChange> out;
  const config::Node* list = resolved.find("change");
  if (list == nullptr) return out;
  for (const config::Node& table : list->children)
    if (const std::optional<PageChange> change = change_of(table)) out.push_back(*change);
  return out;
}

}  // namespace sinew::report
