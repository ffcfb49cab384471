// control/setup/joint_controllers.h - a robot's description turned into the low level's constants,
// in its counts.
#pragma once

#include <vector>

#include "sinew/control/joint/config.h"
#include "sinew/control/setup/installation.h"
#include "sinew/robot/boards.h"

namespace sinew::control {

using robot::has_cylinder_joint;

// Does an interrupt that runs a law take longer than the thesis's program has for it (5.2)?
bool laws_overrun(const robot::Robot& robot);

// Returns the values that the low level's numbers cannot hold, by their keys. Expects a robot
// without other contradictions.
std::vector<robot::Contradiction> misfits(const Installation& installation);

// Returns the constants of a machine of one board, or of one board of it (boards.h). Throws
// std::invalid_argument where the low level cannot be built so (problem).
JointControllerConfig joint_controller_config(const Installation& installation);

}  // namespace sinew::control
