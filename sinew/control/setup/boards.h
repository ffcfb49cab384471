// control/setup/boards.h - the low level as it is built: one controller per board, each with its
// own constants, limits and scan in its own numbers, and what these numbers are in the machine.
#pragma once

#include <cstdint>
#include <vector>

#include "sinew/control/joint/config.h"
#include "sinew/control/setup/installation.h"
#include "sinew/control/supervise/limits.h"

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

}  // namespace sinew::control
