// identify/machine/machine_numbers.h - the numbers of a machine's description by their keys, as the
// field tables name them: joint.hip.damping, valve.inlet.opening_delay,
// muscle.knee_flexor.leak.area.
//
// A fit sets them in a copy of the description that it simulates. Which ones it searches by default
// are groups, by what a run of a robot can show:
//
//   friction    joint.<name>.dry_friction, of a driven joint; trolley.drag, cylinder.friction where
//               these move
//   damping     joint.<name>.damping, of a driven joint; cylinder.damping
//   dead-time   valve.<name>.opening_delay and closing_delay, of valves with a dead time that a
//               muscle uses, or those of their speed-up
//   volume      muscle.<name>.external_volume
//   leak        muscle.<name>.leak.conductance; leak.area where the description has one
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/experiment/experiment.h"

namespace sinew::identify {

// A number of a description, and what its field table says of it.
struct MachineNumber {
  std::string key;           // "joint.hip.damping"
  std::string unit;          // SI
  double low = 0, high = 0;  // that its field may have
  double* value = nullptr;   // in the description that it was found in
};

// Returns all numbers of the machine and of its start; they point into the description.
std::vector<MachineNumber> machine_numbers(experiment::Experiment& experiment);

// Returns the keys that `asked` names: keys, and groups for those of their keys that the machine
// has. Where nothing is asked, those of all groups. Each key stands there once.
// Throws config::Error for a word that is neither, and for a group without a key.
std::vector<std::string> machine_keys(experiment::Experiment& experiment,
                                      const std::vector<std::string>& asked);

// Returns what a change of that number is that matters, in its unit: a share of its value, and
// where that is 0 a size that its group knows; > 0.
double machine_scale(const experiment::Experiment& experiment, const MachineNumber& number);

}  // namespace sinew::identify
