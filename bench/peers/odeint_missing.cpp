// Replaces odeint_stand.cpp if Boost is not installed.
#include <stdexcept>

#include "bench/peers/stand_peers.h"

namespace sinew::bench {

std::string odeint_version() { return "none"; }
void by_odeint(double, int, Lengths&) { throw std::runtime_error("odeint is not compiled in"); }

}  // namespace sinew::bench
