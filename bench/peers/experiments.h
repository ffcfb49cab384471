// bench/peers/experiments.h - experiments of the rows, and one control loop for all bodies.
#pragma once

#include <string>
#include <vector>

#include "sinew/experiment/experiment.h"
#include "sinew/signals/port.h"

namespace sinew::bench {

// Returns the path of a file under experiments/.
std::string experiment_file(const std::string& name);

// Test 1, four steps along the table.
const experiment::Experiment& walk();

// Returns walks of test 1, each with different noise.
std::vector<experiment::Experiment> walks(int count);

// Runs these in so many lanes on one thread; returns their number.
double in_lanes(const std::vector<experiment::Experiment>& each, int lanes, bool recorded);

// Runs a body with the experiment's gait controller and joint controllers to the end, without
// recording. Returns the simulated time [s].
double drive(signals::Port& body, const experiment::Experiment& experiment);

}  // namespace sinew::bench
