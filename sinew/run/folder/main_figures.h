// run/folder/main_figures.h - what is told of a run of which nothing is reported.
#pragma once

#include <string>

#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/verdict/summary.h"

namespace sinew::run {

// Returns lines of text: times, the way, each joint's excursion, error and passiveness, air. No
// paper gives the units here, so lengths are in millimetres.
std::string main_figures(const analysis::Summary& summary, const analysis::Machine& machine);

}  // namespace sinew::run
