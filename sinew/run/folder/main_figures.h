// run/folder/main_figures.h - what is told of a run of which nothing is reported.
#pragma once

#include <string>

#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/verdict/summary.h"
#include "sinew/units/shown.h"

namespace sinew::run {

// Returns lines of text: times, the way, each joint's excursion, error and passiveness, air. No
// paper gives the units here, so lengths are in millimetres.
// Or in those that `shown` has, where there are some.
std::string main_figures(const analysis::Summary& summary, const analysis::Machine& machine,
                         const units::ShownUnits* shown = nullptr);

}  // namespace sinew::run
