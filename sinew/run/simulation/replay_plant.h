// run/simulation/replay_plant.h - recorded valve commands through today's plant: where does it part
// from what was measured?
//
// The machine stands at the experiment's start and is driven by the recording's valves alone. The
// experiment's controllers look on, as they would: what they decide moves nothing.
#pragma once

#include <string>
#include <vector>

#include "sinew/run/simulation/run.h"
#include "sinew/run/simulation/valve_commands.h"

namespace sinew::run {

// Holds what came of it.
struct PlantReplay {
  // The table holds the simulated readings, what only a simulation knows, and the recorded commands
  // in place of the controllers' own.
  Outcome outcome;
  std::vector<std::string> rebuilt;  // as of ValveCommands
};

// Throws config::Error for a recording without valves' commands, and std::invalid_argument for a
// robot that no plant can hold; `name` is the recording's.
PlantReplay replay_plant(const experiment::Experiment& experiment, const signals::Table& recorded,
                         const std::string& name = "recording");

}  // namespace sinew::run
