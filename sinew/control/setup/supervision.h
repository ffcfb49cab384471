// control/setup/supervision.h - what the low level takes for possible, from the robot's
// description: the limits of control/supervise in counts, and what to say when one was broken.
//
//   plausible   of an angle: as far as the muscles that are stretched by it can be, to the length
//               of their thread, and 10 % beyond; of the cylinder: its stroke and 25 % beyond;
//               never the converter's ends. A tension may stand at either end (slack, clipped),
//               a pressure at the lower one.
//   max_rate    of an angle: 60 rad/s, three times the fastest joint that is shipped; else any
#pragma once

#include <string>

#include "sinew/control/setup/installation.h"
#include "sinew/control/supervise/limits.h"
#include "sinew/control/supervise/supervisor.h"

namespace sinew::control {

// Returns the limits of a machine of one board, or of one board of it (boards.h). Throws
// std::invalid_argument where the limits cannot be so (problem).
SuperviseConfig supervise_config(const Installation& installation);

// "sensor hip_angle at 2.0103 s: 4095 count three times in a row, outside its plausible 1075 to
// 2715 count"; "" where the run was not ended. Channel and joint are the machine's; the board, from
// 1, is named where the machine has several.
std::string to_text(const Trip& trip, const robot::Robot& robot, int board = 1);

}  // namespace sinew::control
