// world/stand.cpp - the stand's world, compiled once.
#include "sinew/world/stand.h"

namespace sinew::plant {

template class World<SlideMechanism, StandAir>;

}  // namespace sinew::plant
