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

// Every value as it is used, in SI, under the keys that its origin has.
config::Node values_in_si(MachineFile file);

}  // namespace sinew::experiment
