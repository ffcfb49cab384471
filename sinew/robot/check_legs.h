// robot/check_legs.h - a part of contradictions(robot): how the links hang together, and its legs.
#pragma once

#include <vector>

#include "sinew/robot/robot.h"

namespace sinew::robot {

// Parents that lead nowhere or come later than their children.
void check_tree(const Robot& robot, std::vector<Contradiction>& out);

// Legs that are no paths from the body outwards, that share a joint or leave one out, or whose
// parts are not alike; more discs than the ground can be asked about.
void check_legs(const Robot& robot, std::vector<Contradiction>& out);

}  // namespace sinew::robot
