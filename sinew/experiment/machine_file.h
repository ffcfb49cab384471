// experiment/machine_file.h - reading of a single TOML file: a whole experiment, or a robot,
// actuator, valves or wiring file as part of an otherwise default experiment.
#pragma once

#include <string>
#include <vector>

#include "sinew/config/node.h"
#include "sinew/experiment/experiment.h"

namespace sinew::experiment {

struct MachineFile {
  std::string kind;       // "experiment", "robot", "actuator", "valves" or "wiring"
  Experiment experiment;  // values that are not in the file have their defaults
};

// Reads a file. Throws config::Error with all errors; inside robots/ values without a source are
// errors too.
MachineFile load_machine_file(const std::string& path, const std::vector<std::string>& sets = {});

// Reads a file from a tree that is already composed.
MachineFile load_machine_file(const config::Node& root, const std::string& path);

// Returns every value in SI, under the keys of its origin.
config::Node values_in_si(MachineFile file);

// Returns the file's contents as a file that needs no other: every value in SI, with its source.
std::string resolved(const MachineFile& file, const std::string& version);

}  // namespace sinew::experiment
