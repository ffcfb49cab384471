// bench/peers/experiments.h - experiments of the rows, and one control loop for all bodies.
#pragma once

#include <string>

#include "sinew/experiment/experiment.h"
#include "sinew/signals/port.h"

namespace sinew::bench {

// Returns the path of a file under experiments/.
std::string experiment_file(const std::string& name);

// Test 1, four steps along the table.
const experiment::Experiment& walk();

// Runs a body with the experiment's gait controller and joint controllers to the end, without
// recording. Returns the simulated time [s].
double drive(signals::Port& body, const experiment::Experiment& experiment);

}  // namespace sinew::bench
