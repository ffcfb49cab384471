// identify/machine/run_score.h - score of a machine on a recording that nothing was fitted to: the
// simulated machine is driven by the recorded valve commands alone, open loop, and its angles,
// tensions and pressures are compared with the measured ones.
#pragma once

#include <string>
#include <vector>

#include "sinew/experiment/experiment.h"
#include "sinew/identify/contest/fit.h"
#include "sinew/identify/machine/driven_run.h"

namespace sinew::identify {

// Returns a report for each measured quantity: angles, rates, tensions, gauge pressures, lift, in
// SI. Its `errors` have a part for each joint or muscle; its fit's held-out score has the rms of
// all of them, and the means of their nrmse, correlation and R^2. Samples before `from` [s] are not
// compared; `name` is that of the recording. Throws Refusal if the simulated machine does not reach
// the end of the recording, and config::Error if no sample is left.
std::vector<Report> score_run(const experiment::Experiment& machine, const DrivenRun& run,
                              double from, const std::string& name);

// Returns the description of the scored recording with robot, actuators and valves of the machine,
// and those `keys` of its parameters that concern start or air. Start, supply and room are
// otherwise those of the recording. Adds to `differing` the keys of parameters that differ
// between the descriptions, without `keys`. Throws config::Error, which begins with `name`, if the
// recording is of another machine.
experiment::Experiment scored_machine(experiment::Experiment machine,
                                      experiment::Experiment recorded,
                                      const std::vector<std::string>& keys, const std::string& name,
                                      std::vector<std::string>& differing);

}  // namespace sinew::identify
