// bench/peers/stand_peers.h - the two seconds of appendix A by integrators that adapt their steps.
//
// The right-hand side is that of the thesis (appendix_a.h), except for dry friction: when the sign
// of the speed changes, the integrators stop, check whether the mesh sticks, and restart, since an
// adaptive step across such a discontinuity loses its order. Steps end at the valve's edges.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace sinew::bench {

using Lengths = std::vector<double>;  // at the end of each millisecond [in]

// Return the versions compiled in, or "none".
std::string cvode_version();
std::string odeint_version();

// Simulate with this relative tolerance and write every `every`-th length; others are not changed.
// CVODE: BDF with Newton's method and a dense matrix.
void by_cvode(double tolerance, int every, Lengths& lengths);
// boost::numeric::odeint: Dormand and Prince's fifth order with dense output.
void by_odeint(double tolerance, int every, Lengths& lengths);

}  // namespace sinew::bench
