// run/setup/installation.h - an experiment as what its low level is set up for (control/setup), and
// the boards of that low level.
#pragma once

#include <vector>

#include "sinew/control/setup/boards.h"
#include "sinew/control/setup/installation.h"
#include "sinew/experiment/experiment.h"

namespace sinew::run {

control::Installation installation(const experiment::Experiment& experiment);

// Returns the boards that drive the experiment's robot, or the one of its test stand. Throws as
// control::boards does.
std::vector<control::Board> boards_of(const experiment::Experiment& experiment);

// Returns the robot whose joints and sensors the boards number. For a test stand it has nothing but
// the names of the element and of the transducers.
robot::Robot named_parts(const experiment::Experiment& experiment);

}  // namespace sinew::run
