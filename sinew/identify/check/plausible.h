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

// --- labels of lengths ---

// Adds the answers about the labels of muscles and mounts. Two kinds of evidence:
//
//   - Within a muscle the mount at rest pulls as another length would, beside the other mounts.
//   - Among muscles of one make one follows the others' law with another rest length only.
//
// Each is a suspicion: a law that fits better with another length can be a law that is too simple,
// too. It must explain a good part of what is left, beyond its interval and by more than 1 %. Of
// two muscles nobody can say which one is mislabelled: their make is not asked.
void add_label_checks(const StaticData& data, double atmosphere, std::vector<Check>& out);

}  // namespace sinew::identify
