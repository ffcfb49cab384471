// run/simulation/replay_plant.h - replay of recorded valve commands through today's plant, to
// find where it parts from the measurements.
//
// The machine starts as in the experiment and is driven by the recorded valve commands alone. The
// experiment's controllers run too, but their decisions have no effect.
#pragma once

#include <string>
#include <vector>

#include "sinew/run/simulation/run.h"
#include "sinew/run/simulation/valve_commands.h"

namespace sinew::run {

// The result of a replay.
struct PlantReplay {
  // The table contains the simulated readings, the channels of a simulation only, and the recorded
  // commands instead of the controllers' own.
  Outcome outcome;
  std::vector<std::string> rebuilt;  // as in ValveCommands
};

// Throws config::Error for a recording without valve commands, and std::invalid_argument for a
// robot that exceeds the limits of the plant; `name` is the recording's.
PlantReplay replay_plant(const experiment::Experiment& experiment, const signals::Table& recorded,
                         const std::string& name = "recording");

}  // namespace sinew::run
