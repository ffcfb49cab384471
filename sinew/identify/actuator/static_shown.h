// identify/actuator/static_shown.h - what a static report shows beside its models: the chosen law
// along each curve with its intervals, its error by part, and what was left out.
#pragma once

#include <span>

#include "sinew/identify/actuator/static.h"
#include "sinew/identify/actuator/static_groups.h"

namespace sinew::identify {

// Fills in the report's curves, errors and left_out; its rows and the chosen law are there.
void show_static(const StaticSplit& split, std::span<const StaticOmitted> left_out,
                 StaticResult& result);

}  // namespace sinew::identify
