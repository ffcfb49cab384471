// cli/report.h - what a run has to say about itself, for `run` and `analyze`.
#pragma once

#include <string>
#include <vector>

#include "sinew/analysis/machine.h"
#include "sinew/analysis/stand.h"
#include "sinew/analysis/summary.h"
#include "sinew/experiment/run.h"

namespace sinew::cli {

// Title, and what the source reports beside what came out.
void print_verdicts(const analysis::Summary& summary, const analysis::Machine& machine);
void print_verdicts(const analysis::Summary& summary, const analysis::StandFile& stand);

// Returns warnings of what neither the figures nor the log of a run show: what came late on this
// computer, readings without a channel of their own, faults that never acted.
std::vector<std::string> warnings_beside_the_log(const experiment::Experiment& experiment,
                                                 const experiment::Outcome& outcome);

// Why the run ended early, with the last record of every topic.
std::string black_box(const experiment::Experiment& experiment, const experiment::Outcome& outcome);

}  // namespace sinew::cli
