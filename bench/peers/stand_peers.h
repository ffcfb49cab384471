// bench/peers/stand_peers.h - the two seconds of appendix A by integrators that adapt their steps.
//
// The right-hand side is that of the thesis (appendix_a.h), except for dry friction: when the sign
// of the speed changes, the integrators stop, check whether the mesh sticks, and restart, since an
// adaptive step across such a discontinuity loses its order. Steps end at the valve's edges.
#pragma once

#include <string>
#include <vector>

namespace sinew::bench {

using Lengths = std::vector<double>;  // at the end of each millisecond [in]

// CVODE: BDF with Newton's method and a dense matrix. boost's odeint: Dormand and Prince's fifth
// order with dense output.
struct StandPeer {
  std::string name, version;
  // Simulates with this relative tolerance and writes every `every`-th length; others are not
  // changed.
  void (*run)(double tolerance, int every, Lengths& lengths);
};

StandPeer cvode_stand();
StandPeer odeint_stand();

// Returns the peers that were installed when the program was built.
std::vector<StandPeer> stand_peers();

}  // namespace sinew::bench
