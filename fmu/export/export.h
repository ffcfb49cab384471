// fmu/export/export.h - export of a file as an FMU for co-simulation in other programs: an
// actuator, a muscle with its valves, joints, or a whole machine with its controllers.
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
// `without_valves` makes a tube of a muscle. For an experiment, a request for a muscle or for
// joints uses its robot.
#pragma once

#include <string>
#include <vector>

#include "fmu/slave/variable.h"

namespace sinew::fmu {

// File to export as an FMU, and the variables to include.
struct ExportRequest {
  std::string file;
  std::vector<std::string> sets;  // key=value, overrides the file's
  std::string name;               // model name; empty: from the file, the muscle or the joints
  int version = 2;                // FMI version: 2 or 3

  std::string actuator;  // for a file with several actuators
  std::string muscle;
  std::vector<std::string> joints;
  bool without_valves = false;
  std::vector<std::string> inputs, outputs, parameters;  // for an experiment, see machine.h

  // Folder lib/sinew of an installation that has the modules for the FMU's binary; empty: next to
  // the program, or in /usr/local or /usr.
  std::string modules;
};

// Exported FMU.
struct Fmu {
  std::string kind, name, identifier, token;
  std::vector<Variable> variables;
  std::string bytes;  // archive; equal descriptions give equal archives
};

// Exports a file. Throws config::Error with all faults of the file, std::invalid_argument for
// requests that contradict each other, and std::runtime_error if the installation lacks the module.
Fmu make_fmu(const ExportRequest& request);

// Return what was made and kept in `file`: the names of its variables as lines of text, or all of
// them as JSON.
std::string text_of(const Fmu& made, const std::string& file);
std::string json_of(const Fmu& made, const std::string& file);

}  // namespace sinew::fmu
