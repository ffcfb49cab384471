// files/new_file.h - a commented file to begin with: valid as it is written, every number a guess.
//
//   files::write_new("robot", "my-arm");   // my-arm/robot.toml, actuator.toml and valves.toml
//   files::write_new("robot", "my-arm", {.actuator = "muscle.toml"});   // of a muscle of your own
//   files::write_new("experiment", "lift", {.of = "my-arm/robot.toml"});   // lift.toml
//
// Its text is that of data/templates, with the name in it. Nothing is overwritten.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::files {

// Returns the kinds: robot, actuator, valves, wiring, experiment, plan, tuning, rig, mapping.
std::span<const std::string_view> new_kinds();

// How a new file is to be.
struct NewOptions {
  std::string folder;    // where it is written; empty: here
  std::string of;        // experiment: the robot's file; plan: the experiment's; empty: Sinew's own
  bool metric = false;   // mm, N, bar in place of in, lbf, psi
  std::string actuator;  // robot: the file of its muscles, which it does not write then
};

// What was written.
struct NewFiles {
  std::vector<std::string> files;     // written, the one that was asked for first
  std::vector<std::string> problems;  // what `check` says against the first one
};

// A name of a robot or rig is that of its folder, any other is a file's. Throws config::Error for a
// kind that there is not, a name that cannot be one, a file that is there already or an `of` of
// another kind, and log::Error where a file cannot be written.
NewFiles write_new(const std::string& kind, const std::string& name,
                   const NewOptions& options = {});

// A muscle that somebody has measured, put into the text of a new robot.

// Returns the text of the robot's template with the first actuator of `file` for its muscles, and
// with what follows from it: both ends are mounted half way between the lengths that it was
// measured at, the moment arm lets 20 deg take half of that way, load cell and supply reach as far
// as its force and its pressures. `reference` is how the new robot calls the file, between quotes;
// numbers are in mm, N, bar where `metric`, else in in, lbf, psi. Throws config::Error where the
// file is no actuator's.
std::string with_muscle(std::string text, const std::string& file, const std::string& reference,
                        bool metric);

}  // namespace sinew::files
