// report/page/parameters.h - table of every value that a run used, and the values that were changed
// during it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/config/node.h"
#include "sinew/json/json.h"

namespace sinew::report {

// A row of the table.
struct Parameter {
  std::string key;          // joint.hip.damping
  std::string value;        // as in resolved.toml: SI
  std::string mark;         // "fit", "guess", "default" or empty
  std::string range;        // "0.3 N m to 1.6 N m"; empty if not given
  std::string uncertainty;  // as written
  std::string source;
};

// Returns the value of a key as written, without its source; empty if the key is missing.
std::string value_text(const config::Node& table, std::string_view key);

// Returns the parameters of a resolved.toml, in its order, without reported figures and empty
// values.
std::vector<Parameter> parameters(const config::Node& resolved);

// A key whose value differs between runs.
struct ParameterRow {
  std::string key;
  std::vector<std::optional<std::string>> values;  // one per run; empty if the run lacks the key
};

// Returns the parameters that differ: those of the first run in its order, then those that only
// others have. Values are compared, not their sources; title and reproduced source do not count.
std::vector<ParameterRow> differing(const std::vector<const std::vector<Parameter>*>& runs);

// A parameter that was changed during a run, by the list [[change]] of its file or by a slider: a
// mark on the page's time axes.
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
