// run/simulation/fault_log.h - what a board kept of the 200 ms before its fault, as a table.
#pragma once

#include <span>
#include <string>

#include "sinew/control/link/telemetry.h"
#include "sinew/experiment/experiment.h"

namespace sinew::run {

// Returns CSV with a line per period, oldest first, of a robot on one board: the run's time [s],
// the board's state and why it is there, the host's frames that it has understood; per sensor the
// last good reading, as converted, and the readings rejected so far [count]; per joint speed
// [count/s], the laws' outputs and duties [%].
std::string fault_log_csv(std::span<const link::Telemetry> log, const experiment::Experiment& e);

}  // namespace sinew::run
