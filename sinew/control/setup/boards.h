// control/setup/boards.h - construction of the low level: one controller per board with its own
// constants, limits and scan, and the relation of its numbers to the machine's.
#pragma once

#include <cstdint>
#include <vector>

#include "sinew/control/joint/config.h"
#include "sinew/control/setup/joint_controllers.h"
#include "sinew/control/supervise/limits.h"
#include "sinew/robot/stand.h"

namespace sinew::control {

// Configuration of a board of the low level.
struct Board {
  JointControllerConfig joint_controller;
  SuperviseConfig limits;

  // Numbers of the machine, by the board's own numbers: joints in the robot's order, then the
  // cylinder; sensors; valves, 2 x muscle + (0 inlet | 1 exhaust), then the four of a cylinder.
  std::vector<std::uint8_t> joint, channel, valve;
};

// Returns the boards in the order of their numbers, which count from 1. Throws
// std::invalid_argument if the low level cannot be built.
std::vector<Board> boards(const Installation& installation);

// Returns the board of a test stand. It has a timed joint if valves fill the stand's element, and
// the transducers as channels in their order. These are converted in the last ticks of a period
// [ticks], so that the host has recent readings when the next period begins. Throws as boards()
// does.
Board stand_board(const robot::Stand& stand, bool three_way, std::uint16_t period);

}  // namespace sinew::control
