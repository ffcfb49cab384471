// experiment/spinal.h - a robot's description turned into the low level's constants, in its counts.
#pragma once

#include <vector>

#include "sinew/control/joint/config.h"
#include "sinew/experiment/experiment.h"
#include "sinew/robot/boards.h"

namespace sinew::experiment {

using robot::has_cylinder_joint;

// Does an interrupt that runs a law take longer than the thesis's program has for it (5.2)?
bool laws_overrun(const robot::Robot& robot);

// Returns the values that the low level's numbers cannot hold, by their keys. Expects a robot
// without other contradictions.
std::vector<robot::Contradiction> misfits(const Experiment& experiment);

// Returns the constants of a machine of one board, or of one board of it (boards.h). Throws
// std::invalid_argument where the low level cannot be built so (control::problem).
control::SpineConfig spine_config(const Experiment& experiment);

}  // namespace sinew::experiment
