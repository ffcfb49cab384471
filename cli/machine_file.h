// cli/machine_file.h - any of the TOML files as `show`, `check` and the calculators read it: an
// experiment whole, a robot, actuator or valves file as the part of an experiment that it is.
#pragma once

#include <string>
#include <vector>

#include "sinew/config/node.h"
#include "sinew/config/origin.h"
#include "sinew/config/reader.h"
#include "sinew/experiment/experiment.h"

namespace sinew::cli {

struct MachineFile {
  std::string kind;                   // "experiment", "robot", "actuator" or "valves"
  experiment::Experiment experiment;  // what the file does not say keeps its default
  config::Origins origins;
  std::vector<config::Problem> warnings;
};

// Throws config::Error with everything that is wrong with the file; inside robots/ that includes
// values without a source.
MachineFile read_machine_file(const std::string& path, const std::vector<std::string>& sets = {});

// Values outside robots/ that do not say where they come from. For a file that can be read.
std::vector<config::Problem> without_source(const std::string& path);

// The experiment's phases that lead where the leg cannot reach.
std::vector<config::Problem> unreachable(const experiment::Experiment& experiment);

// Every value as it is used, in SI, under the keys that its origin has.
config::Node values_in_si(MachineFile& file);

}  // namespace sinew::cli
