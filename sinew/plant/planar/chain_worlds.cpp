// plant/planar/chain_worlds.cpp - the worlds of chains, compiled once.
#include "sinew/plant/planar/machine.h"
#include "sinew/plant/world/members.h"

namespace sinew::plant {

template class World<ChainMechanism<1>, muscle::BankAir>;
template class World<ChainMechanism<2>, muscle::BankAir>;

}  // namespace sinew::plant
