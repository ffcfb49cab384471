// run/setup/stand_setup.h - from an experiment on the test stand to the world that it needs.
#pragma once

#include "sinew/experiment/experiment.h"
#include "sinew/mechanism/slide/setup.h"

namespace sinew::run {

// Returns the stand of an experiment that has one, with what breaks while it runs. Expects a list
// [[fault]] without contradictions.
plant::StandSetup stand_setup(const experiment::Experiment& experiment);

// Adds what the world itself refuses, as a load that hangs at no length.
void check_stand_setup(const experiment::Experiment& experiment,
                       std::vector<robot::Contradiction>& wrong);

}  // namespace sinew::run
