#include "sinew/identify/check/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "sinew/identify/check/plausible.h"
#include "sinew/identify/fit/refusal.h"

namespace sinew::identify {

namespace {

// A file given twice under another name has the same readings.
Check repeated(const std::vector<CheckedTable>& tables) {
  for (std::size_t i = 0; i < tables.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const Measured &a = tables[i].table, &b = tables[k].table;
      const bool force = a.has("force") && b.has("force") && a["force"] == b["force"];
      if (force && a["pressure"] == b["pressure"])
        return {"files differ", Light::red,
                fmt::format("{} has the readings of {}.", a.file, b.file),
                "Give each recording once, under its own length."};
    }
  return {"files differ", Light::green, "No file repeats another.", ""};
}

// Converters count in whole numbers.
Check whole_numbers(const std::vector<CheckedTable>& tables) {
  std::set<double> seen;
  for (const CheckedTable& t : tables)
    if (t.table.has("force"))
      for (const double f : t.table["force"]) {
        if (f != std::round(f))
          return {"counts", Light::green, "The forces are no counts of a converter.", ""};
        seen.insert(f);
      }
  if (seen.size() < 20 || *seen.rbegin() < 1000)
    return {"counts", Light::green, "The forces are no counts of a converter.", ""};
  return {"counts", Light::yellow,
          fmt::format("All forces are whole numbers, up to {:.5g}.", *seen.rbegin()),
          "If they are counts, `sinew identify sensor` makes newtons of them."};
}

}  // namespace

std::vector<Check> check_static(const std::vector<CheckedTable>& tables, double diameter) {
  std::vector<Check> out;
  StaticData data;
  double zero = 0;  // the largest that was taken off [N]
  for (const CheckedTable& t : tables) try {
      const double force = add_points(t.table, t.known, data).force;
      if (std::abs(force) > std::abs(zero)) zero = force;
    } catch (const Refusal& refusal) {
      out.push_back({"readable", Light::red, refusal.what(), "Nothing can be fitted to it."});
    }
  if (out.empty())
    out.push_back({"readable", Light::green,
                   fmt::format("{} points; files: {}.", data.points.size(), tables.size()), ""});
  for (const std::string& warning : data.warnings)
    out.push_back({"recording", Light::yellow, warning, "Look at the beginning of the recording."});
  out.push_back(repeated(tables));
  out.push_back(whole_numbers(tables));
  if (data.points.empty()) return out;
  add_unit_checks(data, diameter, zero, out);
  add_curve_checks(data, out);
  add_reach_checks(data, out);
  return out;
}

std::string_view word(Light light) {
  return light == Light::green ? "green" : light == Light::yellow ? "yellow" : "red";
}

bool has_red(const std::vector<Check>& checks) {
  return std::ranges::any_of(checks, [](const Check& c) { return c.light == Light::red; });
}

}  // namespace sinew::identify
