// run/bring_up/wiring_drawing.h - which wire goes where, as a picture.
#pragma once

#include <string>

#include "sinew/control/setup/boards.h"
#include "sinew/experiment/experiment.h"

namespace sinew::run {

// Returns an SVG of a board with its sensors on the left, its valves on the right, the supply and
// its dump valve below: channels and bits, and the terminals' pins where the robot's [wiring] has
// them.
std::string wiring_drawing(const experiment::Experiment& experiment, const control::Board& board);

}  // namespace sinew::run
