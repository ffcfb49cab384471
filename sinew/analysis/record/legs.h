// analysis/record/legs.h - legs of a machine with several ones, each as a machine of its own.
//
// Topics of leg `left` are under /leg/left in a log. A Record of that leg reads them by their names
// without that prefix, so that the same code computes the figures of a leg and of a machine with
// one leg. In a summary they are under legs.left.
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

// Returns the legs; empty for a machine without [leg.*], which is its own leg.
std::vector<MachineLeg> legs_of(const Machine&);

}  // namespace sinew::analysis
