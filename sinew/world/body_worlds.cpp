// world/body_worlds.cpp - the worlds of machines that are no chain, of few links, compiled
// once.
#include "sinew/world/machine.h"

namespace sinew::plant {

template class BodyMechanism<2, 4, 8>;
template class BodyMechanism<3, 2, 4>;
template class BodyMechanism<4, 4, 8>;

template class World<BodyMechanism<2, 4, 8>, air::AirNetwork<8>>;
template class World<BodyMechanism<3, 2, 4>, air::AirNetwork<4>>;
template class World<BodyMechanism<4, 4, 8>, air::AirNetwork<8>>;

}  // namespace sinew::plant
