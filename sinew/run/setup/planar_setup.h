// run/setup/planar_setup.h - setup of the simulated world of an experiment.
#pragma once

#include <vector>

#include "sinew/air/muscle.h"
#include "sinew/experiment/experiment.h"
#include "sinew/mechanism/planar/setup.h"
#include "sinew/world/machine.h"

namespace sinew::run {

// Returns the robot's muscles with their actuators and valves, in its order.
std::vector<air::Muscle> muscles_of(const experiment::Experiment& experiment);

// Returns a planar world for the experiment's robot.
plant::Setup planar_setup(const experiment::Experiment& experiment);

// Returns the planar world, or the experiment's test stand (stand_setup.h).
plant::AnySetup machine_setup(const experiment::Experiment& experiment);

}  // namespace sinew::run
