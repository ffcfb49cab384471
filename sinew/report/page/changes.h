// report/page/changes.h - parameters that were changed during a run, by the list [[change]] of its
// file or by a slider: marks on the page's time axes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/config/node.h"
#include "sinew/json/json.h"

namespace sinew::report {

// A change of one parameter.
struct PageChange {
  double time = 0;       // [s]
  std::string key;       // control.gains.hip.angle
  bool release = false;  // the parameter returns to the plan's value
  double value = 0;      // [unit]
  std::string unit;      // SI
  std::string leg{};     // name of the leg; empty: every leg
};

// Reads the list of a resolved.toml, in its order. Entries that are not in its form are left out.
std::vector<PageChange> changes_of(const config::Node& resolved);

// Returns a JSON array: [{"time": 3, "key": …, "value": 0.004, "unit": "1/count"}, …]; null is the
// value of a release.
Json to_json(const std::vector<PageChange>& changes);

}  // namespace sinew::report
