// identify/check/label.h - lengths that are probably written down wrong.
#pragma once

#include <vector>

#include "sinew/identify/check/check.h"

namespace sinew::identify {

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
