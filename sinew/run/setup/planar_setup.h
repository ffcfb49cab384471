// run/setup/planar_setup.h - an experiment as the world that it takes place in.
#pragma once

#include <vector>

#include "sinew/air/muscle.h"
#include "sinew/experiment/experiment.h"
#include "sinew/mechanism/planar/setup.h"
#include "sinew/world/machine.h"

namespace sinew::run {

// The robot's muscles with their actuators and valves, in its order.
std::vector<air::Muscle> muscles_of(const experiment::Experiment& experiment);

// A planar world for the experiment's robot.
plant::Setup planar_setup(const experiment::Experiment& experiment);

// That, or the experiment's test stand (stand_setup.h).
plant::AnySetup machine_setup(const experiment::Experiment& experiment);

}  // namespace sinew::run
