// world/large_body_worlds.cpp - the worlds of machines of many links, compiled once.
#include "sinew/world/machine.h"

namespace sinew::plant {

template class BodyMechanism<8, 8, 8>;
template class BodyMechanism<most_joints, robot::max_discs, most_muscles>;

template class World<BodyMechanism<8, 8, 8>, air::AirNetwork<8>>;
template class World<BodyMechanism<most_joints, robot::max_discs, most_muscles>,
                     air::AirNetwork<most_muscles>>;

}  // namespace sinew::plant
