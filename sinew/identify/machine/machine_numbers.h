// identify/machine/machine_numbers.h - parameters of a machine's description by their
// keys, as the field tables name them: joint.hip.damping, valve.inlet.opening_delay,
// muscle.knee_flexor.leak.area.
//
// A fit sets them in a copy of the description that it simulates (experiment/numbers.h). The
// parameters that it searches by default are in groups, by what a run of a robot can show:
//
//   friction    joint.<name>.dry_friction, of a driven joint; trolley.drag, cylinder.friction where
//               these move
//   damping     joint.<name>.damping, of a driven joint; cylinder.damping
//   dead-time   valve.<name>.opening_delay and closing_delay, of valves with a dead time that a
//               muscle uses, or those of their speed-up
//   volume      muscle.<name>.external_volume
//   leak        muscle.<name>.leak.conductance; leak.area where the description has one
#pragma once

#include <string>
#include <vector>

#include "sinew/experiment/experiment.h"

namespace sinew::identify {

// A parameter of a description, with the properties from its field table.
struct MachineNumber {
  std::string key;           // "joint.hip.damping"
  std::string unit;          // SI
  double low = 0, high = 0;  // range of its field
  double value = 0;          // in the description
};

// Returns all parameters of the machine and of its start.
std::vector<MachineNumber> machine_numbers(experiment::Experiment experiment);

// Returns the keys for the words in `requested`: keys, and groups for those of their keys that
// the machine has. Empty: all groups. Each key is returned once. Throws config::Error for a
// word that is neither, and for a group without a key.
std::vector<std::string> machine_keys(const experiment::Experiment& experiment,
                                      const std::vector<std::string>& requested);

// Returns the size of a significant change of the parameter, in its unit: a share of its value, or
// if that is 0 a typical size of its group; > 0.
double machine_scale(const experiment::Experiment& experiment, const MachineNumber& number);

}  // namespace sinew::identify
