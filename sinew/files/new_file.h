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

}  // namespace sinew::files
