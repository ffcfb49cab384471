// run/setup/planar_setup.h - an experiment as the world that it takes place in.
#pragma once

#include "sinew/experiment/experiment.h"
#include "sinew/plant/planar/setup.h"

namespace sinew::run {

// A planar world for the experiment's robot.
plant::Setup planar_setup(const experiment::Experiment& experiment);

}  // namespace sinew::run
