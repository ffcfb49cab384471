#include "sinew/identify/check/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "sinew/identify/check/label.h"
#include "sinew/identify/check/plausible.h"
#include "sinew/identify/contest/refusal.h"

namespace sinew::identify {

namespace {

// Checks for a file that is given twice under different names: it has the same readings.
Check repeated(const std::vector<CheckedTable>& tables) {
  for (std::size_t i = 0; i < tables.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const Measured &a = tables[i].table, &b = tables[k].table;
      const bool force = a.has("force") && b.has("force") && a["force"] == b["force"];
      if (force && a["pressure"] == b["pressure"])
        return {"files differ", TrafficLight::red,
                fmt::format("{} has the readings of {}.", a.file, b.file),
                "Give each recording once, under its own length."};
    }
  return {"files differ", TrafficLight::green, "No file repeats another.", ""};
}

// Checks for forces in whole numbers, which are converter counts.
Check whole_numbers(const std::vector<CheckedTable>& tables) {
  std::set<double> seen;
  for (const CheckedTable& t : tables)
    if (t.table.has("force"))
      for (const double f : t.table["force"]) {
        if (f != std::round(f))
          return {"counts", TrafficLight::green, "The forces are no counts of a converter.", ""};
        seen.insert(f);
      }
  if (seen.empty()) return {"counts", TrafficLight::green, "The forces are those of loads.", ""};
  if (seen.size() < 20 || *seen.rbegin() < 1000)
    return {
        "counts", TrafficLight::grey,
        "Not checked: too few different forces to distinguish counts of a converter from newtons.",
        "If they are counts, `sinew identify sensor` makes newtons of them."};
  return {"counts", TrafficLight::yellow,
          fmt::format("All forces are whole numbers, up to {:.5g}.", *seen.rbegin()),
          "If they are counts, `sinew identify sensor` makes newtons of them."};
}

std::string all_words(const Check& check) {
  return fmt::format("{}: {}{}{}", check.name, check.evidence, check.advice.empty() ? "" : " ",
                     check.advice);
}

}  // namespace

void CheckInput::add(CheckedTable table) {
  const double force = add_points(table.table, table.known, data).force;
  if (std::abs(force) > std::abs(zero)) zero = force;
  tables.push_back(std::move(table));
}

void CheckInput::add_or_report(CheckedTable table) try {
  add(table);
} catch (const Refusal& refusal) {
  unreadable.push_back(
      {"readable", TrafficLight::red, refusal.what(), "Nothing can be fitted to it.", false});
  tables.push_back(std::move(table));
}

std::vector<Check> check_static(const CheckInput& input) {
  std::vector<Check> out = input.unreadable;
  const StaticData& data = input.data;
  if (out.empty())
    out.push_back({"readable", TrafficLight::green,
                   fmt::format("{} points; files: {}.", data.points.size(), input.tables.size()),
                   ""});
  for (const std::string& warning : data.warnings)
    out.push_back({"recording", TrafficLight::yellow, warning,
                   "Examine the beginning of the recording.", true});
  out.push_back(repeated(input.tables));
  out.push_back(whole_numbers(input.tables));
  if (data.points.empty()) return out;
  add_unit_checks(data, input.diameter, input.zero, out);
  add_curve_checks(data, out);
  add_reach_checks(data, input.braid.has_value(), out);
  if (!has_red(out)) add_label_checks(data, input.atmosphere, out);
  return out;
}

std::string_view word(TrafficLight light) {
  constexpr std::string_view words[] = {"green", "grey", "yellow", "red"};
  return words[static_cast<std::size_t>(light)];
}

bool has_red(const std::vector<Check>& checks) {
  return std::ranges::any_of(checks, [](const Check& c) { return c.light == TrafficLight::red; });
}

void apply_checks(const std::vector<Check>& checks, bool anyway,
                  std::vector<std::string>& warnings) {
  std::string reds;
  int count = 0;
  for (const Check& c : checks)
    if (c.light == TrafficLight::red) {
      reds += all_words(c) + "\n";
      ++count;
    }
  if (count > 0 && !anyway)
    throw Refusal(reds +
                  fmt::format("check: found {} red, above; expected what a fit can be right "
                              "about; try what is advised there, or anyway=true to fit it as "
                              "it is",
                              count));
  for (const Check& c : checks)
    if (c.light == TrafficLight::red || (c.light == TrafficLight::yellow && !c.shown_by_fit))
      warnings.push_back(all_words(c));
}

}  // namespace sinew::identify
