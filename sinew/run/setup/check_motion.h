// run/setup/check_motion.h - a part of refuse_unbuildable: what the simulated machine and its
// plan cannot be together.
#pragma once

#include <vector>

#include "sinew/experiment/experiment.h"

namespace sinew::run {

// Adds muscles whose chambers would vanish within the reach of the motion, and machines that would
// need steps of less than 2 us.
void check_motion(const experiment::Experiment& experiment, std::vector<robot::Contradiction>& out);

// Returns the ends of the plan's reach that no muscle can pull a joint to: not wrong, as a load or
// a swing may take it there, but worth a warning.
std::vector<robot::Contradiction> beyond_reach(const experiment::Experiment& experiment);

}  // namespace sinew::run
