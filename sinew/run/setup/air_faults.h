// run/setup/air_faults.h - the faults of an experiment as they act in the simulated air.
#pragma once

#include <vector>

#include "sinew/air/fault.h"
#include "sinew/experiment/experiment.h"

namespace sinew::run {

// Adds that there are more faults of the air than an air network schedules.
void check_air_faults(const experiment::Experiment& experiment,
                      std::vector<robot::Contradiction>& out);

// The faults of the air, in their order, for a plant. Expects a list without contradictions.
std::vector<air::AirFault> air_faults(const experiment::Experiment& experiment);

}  // namespace sinew::run
