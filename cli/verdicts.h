// cli/verdicts.h - what is reported of a run beside what came out, for people.
#pragma once

#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/stand.h"
#include "sinew/analysis/summary.h"

namespace sinew::cli {

// Prints the title, and what the source reports beside what came out.
void print_verdicts(const analysis::Summary& summary, const analysis::Machine& machine);
void print_verdicts(const analysis::Summary& summary, const analysis::StandFile& stand);

}  // namespace sinew::cli
