// plant/slide/stand.cpp - the stand's world, compiled once.
#include "sinew/plant/slide/stand.h"

#include "sinew/plant/world/members.h"

namespace sinew::plant {

template class World<SlideMechanism, StandAir>;

}  // namespace sinew::plant
