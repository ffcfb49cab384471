// fmu/export/export.h - a file of ours as an FMU: an actuator, a muscle with its valves, joints, or
// a whole machine with its controllers, for somebody else's co-simulation.
//
//   const Fmu fmu = make_fmu({.file = "robots/leg/robot.toml", .muscle = "hip_flexor"});
//   run::write_file("hip_flexor.fmu", fmu.bytes);
//
//   file         with                kind
//   actuator     -                   tube      length, rate, gauge pressure -> tension
//   rig          -                   muscle    length, rate, valves' currents -> tension
//   robot        muscle              muscle    the same
//   robot        joints, or nothing  joint     angles, rates, valves' currents -> torques
//   experiment   -                   machine   settings -> all channels of a run
//
// `without_valves` makes a tube of a muscle. An experiment is taken as its robot where a muscle or
// joints are asked for.
#pragma once

#include <string>
#include <vector>

#include "fmu/slave/variable.h"

namespace sinew::fmu {

// Says of which file an FMU is to be made, and what an importer is to see of it.
struct Asked {
  std::string file;
  std::vector<std::string> sets;  // key=value in place of the file's
  std::string name;               // of the model; empty: from the file, the muscle or the joints
  int version = 2;                // of FMI: 2 or 3

  std::string actuator;  // of a file with several
  std::string muscle;
  std::vector<std::string> joints;
  bool without_valves = false;
  std::vector<std::string> inputs, outputs, parameters;  // of an experiment, machine.h

  // The folder lib/sinew of an installation, whose modules become the FMU's binary; empty: beside
  // the program, or below /usr/local or /usr.
  std::string modules;
};

// Holds an FMU that was made.
struct Fmu {
  std::string kind, name, identifier, token;
  std::vector<Variable> variables;
  std::string bytes;  // of the archive; equal descriptions give equal ones
};

// Throws config::Error with all that is wrong with the file, std::invalid_argument for what does
// not go together, and std::runtime_error where this installation lacks the module.
Fmu make_fmu(const Asked& asked);

// Return what was made and kept in `file`: the names of its variables as lines of text, or all of
// them as JSON.
std::string text_of(const Fmu& made, const std::string& file);
std::string json_of(const Fmu& made, const std::string& file);

}  // namespace sinew::fmu
