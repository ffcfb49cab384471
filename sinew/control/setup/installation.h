// control/setup/installation.h - what a low level is set up for: a robot with the parts that its
// file names, the air that it works with, and how long it vents before it begins.
#pragma once

#include <vector>

#include "sinew/actuator/actuator.h"
#include "sinew/gas/valve.h"
#include "sinew/robot/robot.h"
#include "sinew/signals/timing.h"

namespace sinew::control {

struct Installation {
  robot::Robot robot;
  std::vector<actuator::Actuator> actuators;  // that its muscles name
  std::vector<gas::Valve> valves;
  double atmosphere = 0;       // [Pa]
  double supply_pressure = 0;  // absolute [Pa]
  signals::ValveTiming timing = signals::identity_timing();
  double settle = 0;  // exhausts open, before the first phase [s]
};

}  // namespace sinew::control
