// bench/peers/stand_peers.h - the two seconds of appendix A by integrators that adapt their steps.
//
// The right-hand side is the thesis's own (appendix_a.h), but for its dry friction: where the sign
// of the speed changes they stop, look whether the mesh sticks, and go on from there, for an
// adaptive step across such a corner has no order at all. Steps end at the valve's edges.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace sinew::bench {

using Lengths = std::vector<double>;  // at the end of each millisecond [in]

// Return the versions that were compiled in, or "none".
std::string cvode_version();
std::string odeint_version();

// With the relative tolerance, looked at each `every` ms; the other lengths stay as they are.
// CVODE: BDF with Newton's method and a dense matrix.
void by_cvode(double tolerance, int every, Lengths& lengths);
// boost::numeric::odeint: Dormand and Prince's fifth order with dense output.
void by_odeint(double tolerance, int every, Lengths& lengths);

}  // namespace sinew::bench
