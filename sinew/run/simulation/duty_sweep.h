// run/simulation/duty_sweep.h - a sweep of a pulsed test stand: each duty on a stand of its own,
// all from the same start.
#pragma once

#include "sinew/run/simulation/run.h"

namespace sinew::run {

// Runs the sweep of an experiment that has one. The table has a row per duty: what the stand
// settled at, over the last five periods. The same bits on any number of threads.
Outcome sweep_duties(const experiment::Experiment& experiment, const RunOptions& options);

}  // namespace sinew::run
