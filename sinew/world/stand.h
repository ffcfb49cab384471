// world/stand.h - the test stand of figures 2-7 and 3-5 as a Port: one muscle and what pulls
// it.
//
//   world/kernel/world.h        nodes, cuts, events, peeks     slide_mechanism.h  what moves
//   stand_air.h          its air                        senses.h           transducers, the truth
#pragma once

#include "sinew/mechanism/slide/slide_mechanism.h"
#include "sinew/world/kernel/world.h"

namespace sinew::plant {

using Stand = World<SlideMechanism, StandAir>;
extern template class World<SlideMechanism, StandAir>;

}  // namespace sinew::plant
