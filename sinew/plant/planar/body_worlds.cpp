// plant/planar/body_worlds.cpp - the worlds of machines that are no chain, compiled once.
#include "sinew/plant/planar/machine.h"
#include "sinew/plant/world/members.h"

namespace sinew::plant {

template class World<BodyMechanism, Air>;

}  // namespace sinew::plant
