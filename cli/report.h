// cli/report.h - what a run has to say about itself, for `run` and `analyze`.
#pragma once

#include <string>

#include "cli/terminal.h"
#include "sinew/analysis/machine.h"
#include "sinew/analysis/stand.h"
#include "sinew/analysis/summary.h"
#include "sinew/experiment/run.h"

namespace sinew::cli {

// Title, and what the source reports beside what came out.
void print_verdicts(const analysis::Summary& summary, const analysis::Machine& machine);
void print_verdicts(const analysis::Summary& summary, const analysis::StandFile& stand);

// What went on in the run that its figures do not show.
void warn_of(const experiment::Experiment& experiment, const experiment::Outcome& outcome,
             const Messages& messages);

// Why the run ended early, with the last record of every topic.
std::string black_box(const experiment::Experiment& experiment, const experiment::Outcome& outcome);

}  // namespace sinew::cli
