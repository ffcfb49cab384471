// control/setup/supervision.h - the limits of control/supervise in counts, from the robot's
// description, and texts for limits that were exceeded.
//
//   plausible   of an angle: up to the thread length of the muscles that it stretches, and 10 %
//               beyond; of the cylinder: its stroke and 25 % beyond; never the converter's ends.
//               A tension may be at either end (slack, clipped), a pressure at the lower one.
//   max_rate    of an angle: 60 rad/s, three times the fastest joint of the supplied robots; of
//               other sensors unlimited
#pragma once

#include <string>

#include "sinew/control/setup/joint_controllers.h"
#include "sinew/control/supervise/limits.h"
#include "sinew/control/supervise/supervisor.h"

namespace sinew::control {

// Returns the limits of a machine with one board, or of one of several boards (boards.h). Throws
// std::invalid_argument if the limits are invalid (problem).
SuperviseConfig supervise_config(const Installation& installation);

// Returns a text such as "sensor hip_angle at 2.0103 s: 4095 count three times in a row, outside
// its plausible 1075 to 2715 count"; "" if the run was not ended. Channel and joint are the
// machine's; the board, from 1, is named if the machine has several.
std::string to_text(const Trip& trip, const robot::Robot& robot, int board = 1);

}  // namespace sinew::control
