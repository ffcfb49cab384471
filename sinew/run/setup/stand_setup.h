// run/setup/stand_setup.h - setup of the simulated test stand of an experiment.
#pragma once

#include "sinew/experiment/experiment.h"
#include "sinew/mechanism/slide/setup.h"

namespace sinew::run {

// Returns the stand of an experiment that has one, with its faults. The list [[fault]] must have no
// contradictions.
plant::StandSetup stand_setup(const experiment::Experiment& experiment);

// Adds what the world itself refuses, for example a load that has no equilibrium at any length.
void check_stand_setup(const experiment::Experiment& experiment,
                       std::vector<robot::Contradiction>& wrong);

}  // namespace sinew::run
