// world/chain_worlds.cpp - the worlds of chains, compiled once.
#include "sinew/world/machine.h"

namespace sinew::plant {

template class World<ChainMechanism<1>, air::AirNetwork<chain_muscles>>;
template class World<ChainMechanism<2>, air::AirNetwork<chain_muscles>>;

}  // namespace sinew::plant
