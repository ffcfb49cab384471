// experiment/spinal.h - a robot's description turned into the low level's constants, in its counts.
#pragma once

#include <vector>

#include "sinew/control/joint/config.h"
#include "sinew/experiment/experiment.h"

namespace sinew::experiment {

// Is there an air cylinder in a loop? It is then the low level's last joint, behind the robot's.
inline bool has_cylinder_joint(const robot::Robot& robot) {
  return robot.cylinder.present && robot.cylinder.mode == robot::Cylinder::Mode::valves;
}

// Does an interrupt that runs a law take longer than the thesis's program has for it (5.2)?
bool laws_overrun(const robot::Robot& robot);

// Returns the values that the low level's numbers cannot hold, by their keys. Expects a robot
// without other contradictions.
std::vector<robot::Contradiction> misfits(const Experiment& experiment);

// Throws std::invalid_argument where the low level cannot be built so (control::problem).
control::SpineConfig spine_config(const Experiment& experiment);

}  // namespace sinew::experiment
