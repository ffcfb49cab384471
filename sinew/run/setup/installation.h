// run/setup/installation.h - the setup of the low level for an experiment (control/setup), and the
// boards of that low level.
#pragma once

#include <vector>

#include "sinew/control/setup/boards.h"
#include "sinew/control/setup/joint_controllers.h"
#include "sinew/experiment/experiment.h"

namespace sinew::run {

control::Installation installation(const experiment::Experiment& experiment);

// Returns the boards that drive the experiment's robot, or the board of its test stand. Throws like
// control::boards.
std::vector<control::Board> boards_of(const experiment::Experiment& experiment);

// Returns the robot whose joints and sensors the boards number. For a test stand it contains only
// the names of the element and of the transducers.
robot::Robot named_parts(const experiment::Experiment& experiment);

}  // namespace sinew::run
