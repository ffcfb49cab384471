// run/setup/check_motion.h - a part of refuse_unbuildable: contradictions between the simulated
// machine and its plan.
#pragma once

#include <vector>

#include "sinew/experiment/experiment.h"

namespace sinew::run {

// Adds muscles whose chambers would have no volume within the range of motion, and machines that
// would need steps of less than 2 us.
void check_motion(const experiment::Experiment& experiment, std::vector<robot::Contradiction>& out);

// Returns the ends of the plan's range that no muscle can pull a joint to. They are warnings, since
// a load or a swing may move the joint there.
std::vector<robot::Contradiction> beyond_reach(const experiment::Experiment& experiment);

}  // namespace sinew::run
