// analysis/record/legs.h - a machine's several legs, each as a machine of its own, and what of a
// summary is theirs.
//
// What a log holds of leg `left` stands under /leg/left; a Record of that leg calls it as if there
// were no other, so that all figures of a leg are made by the same lines. In a summary they stand
// under legs.left.
#pragma once

#include <string>
#include <vector>

#include "sinew/analysis/record/machine.h"

namespace sinew::analysis {

// One leg of a machine, as a machine of its own.
struct MachineLeg {
  std::string name;
  Machine machine;  // with the joints, muscles and foot of that leg alone, named as within it
};

// None of a machine without [leg.*]: it is its own leg.
std::vector<MachineLeg> legs_of(const Machine&);

}  // namespace sinew::analysis
