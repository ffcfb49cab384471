// identify/check/plausible.h - what a braided muscle cannot do, asked of points at rest.
#pragma once

#include <vector>

#include "sinew/identify/check/check.h"

namespace sinew::identify {

// Adds the answers: units, signs, zeros and lengths, then how the curves lie to each other. `zero`
// is what was taken off the forces already [N].
void add_unit_checks(const StaticData& data, double diameter, double zero, std::vector<Check>& out);
void add_curve_checks(const StaticData& data, std::vector<Check>& out);

// Adds how many lengths, pressures and branches there are among what is to be fitted. One length is
// enough where the braid is known from elsewhere.
void add_reach_checks(const StaticData& data, bool braid_is_known, std::vector<Check>& out);

}  // namespace sinew::identify
