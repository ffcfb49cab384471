// run/simulation/duty_sweep.h - a sweep of a pulsed test stand: each duty on a separate stand, all
// with the same start.
#pragma once

#include "sinew/run/simulation/run.h"

namespace sinew::run {

// Runs the sweep of an experiment that has one. The table has a row per duty: the settled values of
// the stand, over the last five periods. The result does not depend on the number of threads.
Outcome sweep_duties(const experiment::Experiment& experiment, const RunOptions& options);

}  // namespace sinew::run
