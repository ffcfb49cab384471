#include "sinew/config/gains.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "sinew/config/diagnostics.h"
#include "sinew/config/rows.h"
#include "sinew/config/text_file.h"
#include "sinew/units/quantity.h"

namespace sinew::config {

namespace {

constexpr const char* gain_columns = "angle gain, stiffness gain, velocity gain";

bool parse_row(std::string_view text, GainRow& row, Problems& problems) {
  const std::vector<Cell> cells = cells_of(text);
  if (cells.size() < 2 || cells.size() > 3) {
    problems.add(row.line, 1, "", fmt::format("{} columns", cells.size()),
                 std::string(gain_columns) + ", the last may be missing",
                 "a comma between two numbers");
    return false;
  }
  double* const values[] = {&row.angle, &row.stiffness, &row.velocity};
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto& [cell, column] = cells[i];
    const char* last = cell.data() + cell.size();
    const auto [end, error] = std::from_chars(cell.data(), last, *values[i]);
    if (error == std::errc{} && end == last && std::isfinite(*values[i])) continue;
    problems.add(row.line, column, "", in_quotes(cell), "a number");
    return false;
  }
  return true;
}

// Returns "0.035 %/count" with its place, as in a robot's file.
Node gain(std::string_view key, double value, std::string_view unit, const Location& where) {
  Node node = make_table(key, where);
  node.put(make_text("value", fmt::format("{} {}", units::format_number(value), unit), where));
  node.put(make_text("source", "gain.dat, B.5", where));
  return node;
}

void put(Node& table, Node node, const std::string& path, const Node& entry) {
  if (const Node* there = table.find(node.key); there && there->where.file == entry.where.file)
    fail(there->where, path, shown(*there),
         fmt::format("no value: files.gains = {} has it", in_quotes(entry.text)));
  table.put(std::move(node));
}

bool has_muscles(const Node& joint) {
  const Node* kind = joint.find("kind");
  return joint.is_table() && !(kind && kind->text == "passive");
}

Node& table_in(Node& root, std::string_view key, const Location& where) {
  Node* there = root.find(key);
  return there && there->is_table() ? *there : root.put(make_table(key, where));
}

void put_joint(Node& joint, const GainRow& row, const Node& entry, const Location& where) {
  const std::string path = "joint." + joint.key;
  const auto one = [&](std::string_view key, double value, std::string_view unit) {
    put(joint, gain(key, value, unit, where), fmt::format("{}.{}", path, key), entry);
  };
  one("angle_gain", row.angle, "%/count");
  one("stiffness_gain", row.stiffness, "%/(lbf in/rad)");
  one("velocity_gain", row.velocity, "% s/count");
}

}  // namespace

std::vector<GainRow> parse_gains(std::string_view text, const std::string& name) {
  std::vector<GainRow> rows;
  Problems problems(name);
  each_row(text, [&](std::string_view line, int number) {
    GainRow row{.line = number};
    parse_row(line, row, problems);
    rows.push_back(row);
  });
  problems.finish();
  return rows;
}

std::vector<GainRow> read_gains(const std::string& path) {
  return parse_gains(read_text_file(path, std::string("rows of ") + gain_columns), path);
}

void put_gains(Node& root, const Node& entry, const std::string& path, bool with_control) {
  const std::vector<GainRow> rows = read_gains(path);
  std::vector<Node*> joints;
  if (Node* all = root.find("joint"))
    for (Node& joint : all->children)
      if (has_muscles(joint)) joints.push_back(&joint);
  if (rows.size() != joints.size() + 1)
    fail({path, rows.empty() ? 1 : rows.back().line, 1}, "", fmt::format("{} rows", rows.size()),
         fmt::format("{}: the cylinder's, then one per joint", joints.size() + 1));

  for (std::size_t j = 0; j < joints.size(); ++j)
    put_joint(*joints[j], rows[j + 1], entry, {path, rows[j + 1].line, 1});
  const Location first{path, rows[0].line, 1};
  if (Node* cylinder = root.find("cylinder"))
    put(*cylinder, gain("position_gain", rows[0].angle, "%/count", first), "cylinder.position_gain",
        entry);
  if (!with_control || joints.empty()) return;
  Node& stiffness = table_in(table_in(root, "control", first), "stiffness", first);
  put(stiffness, gain(joints[0]->key, rows[0].stiffness, "lbf in/rad", first),
      "control.stiffness." + joints[0]->key, entry);
}

}  // namespace sinew::config
