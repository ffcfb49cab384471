// world/stand.h - test stand of figures 2-7 and 3-5 as a Port: one muscle and its load.
//
//   world/kernel/world.h        nodes, cuts, events, previews  slide_mechanism.h  mechanics
//   stand_air.h          its air                        senses.h           transducers, true values
#pragma once

#include "sinew/mechanism/slide/slide_mechanism.h"
#include "sinew/world/kernel/world.h"

namespace sinew::plant {

using Stand = World<SlideMechanism, StandAir>;
extern template class World<SlideMechanism, StandAir>;

}  // namespace sinew::plant
