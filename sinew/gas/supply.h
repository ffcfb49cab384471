// gas/supply.h - where the compressed air comes from.
//
// Constant: a regulator or a tank so large that its pressure does not move (3.4: 100 psi in the
// text, 98 in appendix A). A tank that empties would add a state; see
// docs/theory/gas-and-valves.md.
#pragma once

#include "sinew/gas/air.h"

namespace sinew::gas {

struct Supply {
  enum class Kind { constant };
  Kind kind = Kind::constant;
  double pressure = 790828.661526411;  // absolute [Pa], 100 psi gauge
};

}  // namespace sinew::gas
