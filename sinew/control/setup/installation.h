// control/setup/installation.h - input of the low level's set-up: a robot with the parts that its
// file names, its air supply, and the time of venting before the start.
#pragma once

#include <vector>

#include "sinew/actuator/actuator.h"
#include "sinew/gas/valve.h"
#include "sinew/robot/robot.h"
#include "sinew/signals/timing.h"

namespace sinew::control {

struct Installation {
  robot::Robot robot;
  std::vector<actuator::Actuator> actuators;  // those of its muscles
  std::vector<gas::Valve> valves;
  double atmosphere = 0;       // [Pa]
  double supply_pressure = 0;  // absolute [Pa]
  signals::ValveTiming timing = signals::identity_timing();
  double settle = 0;  // time with open exhausts before the first phase [s]
};

}  // namespace sinew::control
