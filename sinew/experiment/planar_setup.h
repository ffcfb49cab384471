// experiment/planar_setup.h - an experiment as the world that it takes place in, and how long it
// can last.
#pragma once

#include "sinew/experiment/experiment.h"
#include "sinew/plant/planar/setup.h"
#include "sinew/signals/tick.h"

namespace sinew::experiment {

// The last tick that the run can reach.
signals::Tick last_tick(const Experiment& experiment);

// A planar world for the experiment's robot.
plant::Setup planar_setup(const Experiment& experiment);

}  // namespace sinew::experiment
