// identify/task/static_task.h - `sinew identify static`: the static law of an actuator from force,
// length and pressure.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sinew/identify/actuator/static.h"
#include "sinew/identify/check/check.h"

namespace sinew::identify {

struct StaticSettings {
  std::string name = "bpa";            // of the actuator
  std::string model;                   // this one alone; empty: the data choose
  std::string rest_length;             // without pressure and load; empty: the longest length
  std::vector<std::string> lengths;    // of files without a column of it: "205 mm", or
                                       // "PART=205 mm" for files with PART in their name
  std::string actuator;                // a file whose braid is taken as known; empty: none
  std::string branch = "both";         // fill, vent or both
  std::vector<std::string> fit_where;  // "NAME=VALUE,...": only such rows are fitted
  std::string hold_out;                // pressure, length or another file, beside fit_where
  std::optional<Source> held_out;      // another table in place of a file
};

// Holds what was found, with the actuators' files.
struct StaticFound {
  StaticResult result;
  std::vector<std::string> files;  // the actuator's, of each muscle; the longest first
};

// Returns the points of the tables, as a static law would be fitted to them. Throws config::Error
// and Refusal.
StaticData read_static(const std::vector<Source>& sources, const StaticSettings& settings);

// Throws config::Error and Refusal.
StaticFound find_static(const std::vector<Source>& sources, const StaticSettings& settings);

// Asks the tables what a fit would not: see identify/check/check.h. `diameter` is that of the
// muscle without pressure, "10 mm"; empty: not known. A length of no file is a red check, too.
// Throws config::Error for tables that cannot be read.
std::vector<Check> check_before_static(const std::vector<Source>& sources,
                                       const StaticSettings& settings,
                                       const std::string& diameter = "");

}  // namespace sinew::identify
