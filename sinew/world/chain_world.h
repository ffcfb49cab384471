// world/chain_world.h - the world of a chain, as the robot is alone or in a lane.
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
