// control/setup/joint_controllers.h - conversion of a robot's description to the low level's
// constants, in its counts.
#pragma once

#include <vector>

#include "sinew/control/joint/config.h"
#include "sinew/control/setup/installation.h"
#include "sinew/robot/boards.h"

namespace sinew::control {

using robot::has_cylinder_joint;

// Returns whether an interrupt that runs a law takes longer than the thesis's program allows (5.2).
bool laws_overrun(const robot::Robot& robot);

// Returns the values that the low level's numbers cannot represent, by their keys. Requires a robot
// without other contradictions.
std::vector<robot::Contradiction> misfits(const Installation& installation);

// Returns the constants of a machine with one board, or of one of several boards (boards.h). Throws
// std::invalid_argument if the low level cannot be built (problem).
JointControllerConfig joint_controller_config(const Installation& installation);

}  // namespace sinew::control
