// control/setup/boards.h - the low level as it is built: one controller per board, each with its
// own constants, limits and scan in its own numbers, and what these numbers are in the machine.
#pragma once

#include <cstdint>
#include <vector>

#include "sinew/control/joint/config.h"
#include "sinew/control/setup/installation.h"
#include "sinew/control/supervise/limits.h"
#include "sinew/robot/stand.h"

namespace sinew::control {

// A board of the low level as it is to be built.
struct Board {
  JointControllerConfig spine;
  SuperviseConfig limits;

  // By the board's own numbers, those of the machine: joints in the robot's order, with the
  // cylinder's behind them; sensors; valves, 2 x muscle + (0 inlet | 1 exhaust), and the four of a
  // cylinder behind them.
  std::vector<std::uint8_t> joint, channel, valve;
};

// Returns the boards by their numbers, which count from 1. Throws std::invalid_argument where the
// low level cannot be built so.
std::vector<Board> boards(const Installation& installation);

// Returns the board of a test stand. It has a timed joint if valves fill the stand's element, and
// the transducers as channels in their order. They are converted in the last ticks of a period
// [ticks], so that the host has the newest readings when the next period begins. Throws as boards()
// does.
Board stand_board(const robot::Stand& stand, bool three_way, std::uint16_t period);

}  // namespace sinew::control
