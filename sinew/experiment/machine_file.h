// experiment/machine_file.h - any of the TOML files read alone: an experiment whole; a robot,
// actuator, valves or wiring file as the part of an experiment that it is.
#pragma once

#include <string>
#include <vector>

#include "sinew/config/node.h"
#include "sinew/experiment/experiment.h"

namespace sinew::experiment {

struct MachineFile {
  std::string kind;       // "experiment", "robot", "actuator", "valves" or "wiring"
  Experiment experiment;  // what the file does not say keeps its default
};

// Throws config::Error with everything that is wrong with the file; inside robots/ that includes
// values without a source.
MachineFile load_machine_file(const std::string& path, const std::vector<std::string>& sets = {});

// The same from a tree that is composed already.
MachineFile load_machine_file(const config::Node& root, const std::string& path);

// Every value as it is used, in SI, under the keys that its origin has.
config::Node values_in_si(MachineFile file);

// What the file says, as a file that needs no other: every value in SI, with its source.
std::string resolved(const MachineFile& file, const std::string& version);

}  // namespace sinew::experiment
