// identify/actuator/static_shown.h - additional parts of a static report: the chosen law along each
// curve with its intervals, its error by part, and the points that were left out.
#pragma once

#include <span>

#include "sinew/identify/actuator/static.h"
#include "sinew/identify/actuator/static_groups.h"

namespace sinew::identify {

// Fills in the report's curves, errors and left_out. Its rows and the chosen law must be set.
void show_static(const StaticSplit& split, std::span<const StaticOmitted> left_out,
                 StaticResult& result);

}  // namespace sinew::identify
