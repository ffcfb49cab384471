// cli/verdicts.h - what is reported of a run beside what came out, for people.
#pragma once

#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/summary.h"
#include "sinew/units/shown.h"

namespace sinew::cli {

// Prints the title, and what the source reports beside what came out: in the source's own units, or
// in `shown`, where somebody asked for some.
void print_verdicts(const analysis::Summary& summary, const analysis::Machine& machine,
                    const units::ShownUnits* shown = nullptr);

}  // namespace sinew::cli
