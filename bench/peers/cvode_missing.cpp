// Replaces cvode_stand.cpp if SUNDIALS is not installed.
#include <stdexcept>

#include "bench/peers/stand_peers.h"

namespace sinew::bench {

std::string cvode_version() { return "none"; }
void by_cvode(double, int, Lengths&) { throw std::runtime_error("CVODE is not compiled in"); }

}  // namespace sinew::bench
