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

// --- labels of lengths ---

// Adds checks of the labels of muscles and mounts. Two kinds of evidence:
//
//   - Within a muscle, the mount at rest pulls like another length would, compared with the others.
//   - Among muscles of one make, one fits the others' law only with another rest length.
//
// Each gives a suspicion only: a law that fits better with another length may also be too simple.
// The other length must explain a large part of the misfit, beyond its interval, and differ by more
// than 1 %. For two muscles the comparison cannot show which one is mislabelled, and is not made.
void add_label_checks(const StaticData& data, double atmosphere, std::vector<Check>& out);

}  // namespace sinew::identify
