// identify/check/plausible.h - checks of points at rest for behaviour impossible for a braided
// muscle.
#pragma once

#include <vector>

#include "sinew/identify/check/check.h"

namespace sinew::identify {

// Add checks: units, signs, zeros and lengths, and the curves compared with each other. `zero` is
// the force that was already subtracted [N].
void add_unit_checks(const StaticData& data, double diameter, double zero, std::vector<Check>& out);
void add_curve_checks(const StaticData& data, std::vector<Check>& out);

// Adds checks of the number of lengths, pressures and branches among the fitted points. One
// length is enough if the braid is known.
void add_reach_checks(const StaticData& data, bool braid_is_known, std::vector<Check>& out);

}  // namespace sinew::identify
