// report/page/changes.h - what was set while a run went, by the list [[change]] of its file or by a
// slider: marks on the page's time axes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/config/node.h"

namespace sinew::report {

// One setting at one time.
struct PageChange {
  double time = 0;       // [s]
  std::string key;       // control.gains.hip.angle
  bool release = false;  // no value: the plan's own again
  double value = 0;      // [unit]
  std::string unit;      // SI
  std::string leg{};     // whose; empty: every leg's
};

// Reads the list of a resolved.toml, in its order; what it does not say as resolved.toml does is
// left out.
std::vector<PageChange> changes_of(const config::Node& resolved);

// As a JSON array: [{"time": 3, "key": …, "value": 0.004, "unit": "1/count"}, …]; null is the value
// of a release.
std::string to_json(const std::vector<PageChange>& changes);

}  // namespace sinew::report
