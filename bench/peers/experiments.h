// bench/peers/experiments.h - the experiments that the rows go by, and one loop for all bodies.
#pragma once

#include <string>

#include "sinew/experiment/experiment.h"
#include "sinew/signals/port.h"

namespace sinew::bench {

// Returns the path of a file under experiments/.
std::string experiment_file(const std::string& name);

// Test 1, four steps along the table.
const experiment::Experiment& walk();

// The experiment's brain and spinal cord drive a body to the end, nobody recording. Returns the
// simulated time [s].
double drive(signals::Port& body, const experiment::Experiment& experiment);

}  // namespace sinew::bench
