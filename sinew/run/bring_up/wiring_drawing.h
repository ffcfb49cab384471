// run/bring_up/wiring_drawing.h - which wire goes where, as a picture.
#pragma once

#include <string>

#include "sinew/control/setup/boards.h"
#include "sinew/experiment/experiment.h"
#include "sinew/run/bring_up/pins.h"

namespace sinew::run {

// Returns an SVG of a board with its sensors on the left, its valves on the right, the supply and
// its dump valve below: channels and bits, the terminals' pins where the robot's [wiring] has them,
// and the board's own where `pins` is not nullptr.
std::string wiring_drawing(const experiment::Experiment& experiment, const control::Board& board,
                           const Pins* pins);

}  // namespace sinew::run
