// identify/task/pair_task.h - `sinew identify pair`: a sealed antagonistic pair that is moved, from
// effort, position and pressures over time.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/identify/fit/wish.h"
#include "sinew/identify/pair/pair.h"
#include "sinew/json/json.h"

namespace sinew::identify {

// What is asked.
struct PairSettings {
  std::string rigs;              // of each table, between commas; empty: all are of one
  std::string hold_out;          // "7 s..14 s", "7 s..": of each table; empty: none
  std::vector<Source> held_out;  // tables that score the laws; may be among those that are given
  std::string window = "20 ms";  // of the parabolas that give rates
  WishTexts wishes;              // frozen, tied, prior
  std::string model;             // this law alone; empty: all
  std::string joint = "joint";   // its name in a robot's file
  std::string base;              // the robot's file whose joint it is; empty: none
};

// Holds what was found, with the robot's file.
struct PairFound {
  PairResult result;
  std::string joint, base, source;

  // The robot's file, as it would stand at `out`. Throws config::Error, and Refusal for a slide.
  std::string file(const std::string& out) const;
};

// Is the text a range of times, "7 s..14 s", rather than a file's name?
bool is_time_range(std::string_view text);

// Throws config::Error and Refusal; std::invalid_argument for a model that there is not.
PairFound find_pair(const std::vector<Source>& sources, const PairSettings& settings);

// Returns the report with stiffness, sensors and trapped air, as `--json` prints it.
Json to_json(const PairFound& found);

}  // namespace sinew::identify
