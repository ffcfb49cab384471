// files/new_file.h - commented starting files: valid as written, every number a guess.
//
//   files::write_new("robot", "my-arm");   // my-arm/robot.toml, actuator.toml and valves.toml
//   files::write_new("robot", "my-arm", {.actuator = "muscle.toml"});   // with your own muscle
//   files::write_new("experiment", "lift", {.of = "my-arm/robot.toml"});   // lift.toml
//
// The text is a template of data/templates with the name filled in. Nothing is overwritten.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::files {

// Returns the kinds: robot, actuator, valves, wiring, experiment, plan, tuning, rig, mapping.
std::span<const std::string_view> new_kinds();

// Options of a new file.
struct NewOptions {
  std::string folder;    // folder of the new file; empty: the current one
  std::string of;        // base; experiment: a robot; plan: an experiment; empty: Sinew's own
  bool metric = false;   // mm, N, bar instead of in, lbf, psi
  std::string actuator;  // robot: file of its muscles, used instead of a new one
};

// Result of write_new().
struct NewFiles {
  std::vector<std::string> files;     // written files, the requested one first
  std::vector<std::string> problems;  // faults that check() finds in the first one
};

// Writes a new file. The name of a robot or rig is that of its folder, any other name that of a
// file. Throws config::Error for an unknown kind, an invalid name, a file that exists or an `of` of
// the wrong kind, and log::Error if a file cannot be written.
NewFiles write_new(const std::string& kind, const std::string& name,
                   const NewOptions& options = {});

// Use of a measured muscle in a new robot.

// Returns the template's text with the first actuator of `file` as its muscles, and with values
// derived from it: both muscles are mounted at the middle of the measured lengths, the moment arm
// makes 20 deg take half of the way to either end, and load cell and supply cover its force and
// pressures. `reference` is the quoted path of the file from the new robot; numbers are in mm, N,
// bar if `metric`, else in in, lbf, psi. Throws config::Error if the file is not an actuator's.
std::string with_muscle(std::string text, const std::string& file, const std::string& reference,
                        bool metric);

}  // namespace sinew::files
