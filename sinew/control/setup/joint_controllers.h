// control/setup/joint_controllers.h - conversion of a robot's description to the low level's
// constants, in its counts.
#pragma once

#include <vector>

#include "sinew/actuator/actuator.h"
#include "sinew/control/joint/config.h"
#include "sinew/gas/valve.h"
#include "sinew/robot/boards.h"
#include "sinew/robot/robot.h"
#include "sinew/signals/timing.h"

namespace sinew::control {

// Input of the low level's set-up: a robot with the parts that its file names, its air supply, and
// the time of venting before the start.
struct Installation {
  robot::Robot robot;
  std::vector<actuator::Actuator> actuators;  // those of its muscles
  std::vector<gas::Valve> valves;
  double atmosphere = 0;       // [Pa]
  double supply_pressure = 0;  // absolute [Pa]
  signals::ValveTiming timing = signals::identity_timing();
  double settle = 0;  // time with open exhausts before the first phase [s]
};

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
