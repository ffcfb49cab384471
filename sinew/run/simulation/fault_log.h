// run/simulation/fault_log.h - a board's record of the 200 ms before its fault, as a table.
#pragma once

#include <span>
#include <string>

#include "sinew/control/link/telemetry.h"
#include "sinew/experiment/experiment.h"

namespace sinew::run {

// Returns CSV with a line per period, oldest first, for a robot on one board: the run's time [s],
// the board's state and its cause, and the number of accepted host frames; per sensor the last good
// reading, as converted, and the readings rejected so far [count]; per joint its speed [count/s],
// the outputs of the laws and duties [%].
std::string fault_log_csv(std::span<const link::Telemetry> log, const experiment::Experiment& e);

}  // namespace sinew::run
