// report/page/panels.h - panels of a run, from top to bottom: the channels that are plotted
// together.
#pragma once

#include <vector>

#include "sinew/analysis/record/machine.h"
#include "sinew/report/page/plot.h"

namespace sinew::report {

// Returns the panels of the channels over time, without empty ones. Channels that no panel has come
// last, by unit. Setpoints are of kind desired; lines that would repeat another one are hidden.
std::vector<Plot> panels(const Channels& channels, const analysis::Machine& machine);

}  // namespace sinew::report
