// identify/task/static_task.h - `sinew identify static`: the static law of an actuator from force,
// length and pressure.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sinew/identify/actuator/static.h"
#include "sinew/identify/check/checkup.h"

namespace sinew::identify {

struct StaticSettings {
  std::string name = "bpa";            // of the actuator
  std::string model;                   // this one alone; empty: the data choose
  std::string rest_length;             // without pressure and load; empty: the longest length
  std::string actuator;                // a file whose braid is taken as known; empty: none
  std::string branch = "both";         // fill, vent or both
  std::vector<std::string> fit_where;  // "NAME=VALUE,...": only such rows are fitted
  std::string hold_out;                // pressure, length, muscle or another file
  std::optional<Source> held_out;      // another table in place of a file
  std::string diameter;              // without pressure, "10 mm", to compare its force with; empty:
                                     // not known
  bool anyway = false;               // fit where a check is red, too
  std::vector<std::string> predict;  // rest lengths nobody measured: "rest_length=120 mm"
  host::Tally* tried = nullptr;      // counts laws that have been tried; null: nothing
};

// Holds what was found, with the actuators' files.
struct StaticFound {
  StaticResult result;
  std::vector<std::string> files;  // the actuator's, of each muscle; the longest first

  // Muscles of the rest lengths that `predict` asked for, and their files.
  std::vector<StaticMuscle> predicted;
  std::vector<std::string> predicted_files;
};

// Returns the points of the tables, as a static law would be fitted to them. Throws config::Error
// and Refusal.
StaticData read_static(const std::vector<Source>& sources, const StaticSettings& settings);

// Checks the tables first (identify/check/check.h): what is red is refused unless it is to be
// fitted anyway, suspicions become warnings of the report. Throws config::Error and Refusal.
StaticFound find_static(const std::vector<Source>& sources, const StaticSettings& settings);

// Asks the tables what a fit would not, and tells what it could find: see identify/check/checkup.h.
// Throws config::Error for settings that are none.
Checkup check_before_static(const std::vector<Source>& sources, const StaticSettings& settings);

}  // namespace sinew::identify
