// identify/fit/robot_over.h - parameter files that are a part of a robot.
#pragma once

#include <string>

#include "sinew/config/node.h"

namespace sinew::identify {

// Returns the beginning of a robot's file at `out` that adds to the one at `base`; empty: to none.
// Throws config::Error where both are the same file.
config::Node robot_over(const std::string& base, const std::string& out);

}  // namespace sinew::identify
