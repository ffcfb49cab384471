// plant/planar/chain_plumbing_worlds.cpp - the worlds of chains whose air does more than a bank,
// compiled apart: the compiler weighs a file as a whole, and a walk is 7 % slower where both stand
// in one.
#include "sinew/plant/planar/machine.h"
#include "sinew/plant/world/members.h"

namespace sinew::plant {

template class World<ChainMechanism<1>, muscle::PlumbingAir>;
template class World<ChainMechanism<2>, muscle::PlumbingAir>;

}  // namespace sinew::plant
