// report/page/parameters.h - every value that a run used, as rows of a table.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sinew/config/node.h"

namespace sinew::report {

// A value as its row of the table shows it.
struct Parameter {
  std::string key;          // joint.hip.damping
  std::string value;        // as resolved.toml has it: SI
  std::string mark;         // "fit", "guess", "default" or empty
  std::string range;        // "0.3 N m to 1.6 N m"; empty where none is given
  std::string uncertainty;  // as written
  std::string source;
};

// Of a resolved.toml, in its order. What is reported of the run is no parameter, nor is what is
// empty.
std::vector<Parameter> parameters(const config::Node& resolved);

// A key that has not the same value in all runs; nothing where a run has no such key.
struct ParameterRow {
  std::string key;
  std::vector<std::optional<std::string>> values;  // one per run
};

// Of the runs' parameters: in the first one's order, then what only others have. Values count, not
// where they come from; neither do a run's title and what it reproduces.
std::vector<ParameterRow> differing(const std::vector<const std::vector<Parameter>*>& runs);

}  // namespace sinew::report
