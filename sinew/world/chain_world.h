// world/chain_world.h - world of a chain, used for a single robot and for a lane.
#pragma once

#include "sinew/air/network.h"
#include "sinew/mechanism/planar/chain_body.h"
#include "sinew/world/kernel/world.h"

namespace sinew::plant {

template <int N>
using ChainWorld = World<ChainMechanism<N>, air::AirNetwork<chain_muscles>>;

extern template class World<ChainMechanism<1>, air::AirNetwork<chain_muscles>>;
extern template class World<ChainMechanism<2>, air::AirNetwork<chain_muscles>>;

}  // namespace sinew::plant
