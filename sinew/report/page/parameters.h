// report/page/parameters.h - table of every value that a run used.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/config/node.h"

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

}  // namespace sinew::report
