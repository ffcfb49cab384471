// run/setup/buildable.h - experiments whose controllers and simulated machine can be built.
//
// experiment::load refuses a description that contradicts itself. This refuses values that the low
// level cannot represent, and machines that cannot be simulated.
#pragma once

#include <string>
#include <vector>

#include "sinew/experiment/experiment.h"
#include "sinew/experiment/machine_file.h"

namespace sinew::run {

// Throws config::Error with everything that cannot be built in a description without
// contradictions.
void refuse_unbuildable(const experiment::Experiment& experiment);

// Throws config::Error for an experiment as above, and for a robot with numbers that its low level
// cannot represent. Files of parts are never refused.
void refuse_unbuildable(const experiment::MachineFile& file);

// Read the file as experiment::load does, or take a composed tree. Throw config::Error with all
// faults.
experiment::Experiment buildable(const std::string& path,
                                 const std::vector<std::string>& sets = {});
experiment::Experiment buildable(const config::Node& root, const std::string& path);

// Does the same for uses that need a robot; also throws for an experiment on a test stand.
experiment::Experiment buildable_robot(const config::Node& root, const std::string& path);

// Returns the ends of the plan's range that no muscle can pull a joint to. They are warnings, since
// a load or a swing may move the joint there.
std::vector<robot::Contradiction> beyond_reach(const experiment::Experiment& experiment);

}  // namespace sinew::run
