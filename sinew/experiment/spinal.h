// experiment/spinal.h - a robot's description turned into the low level's constants, in its counts.
#pragma once

#include "sinew/control/joint/config.h"
#include "sinew/experiment/experiment.h"

namespace sinew::experiment {

// Throws std::invalid_argument where the low level cannot be built so (control::problem).
control::SpineConfig spine_config(const Experiment& experiment);

}  // namespace sinew::experiment
