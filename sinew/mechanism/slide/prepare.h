// mechanism/slide/prepare.h - a stand's set-up, checked and completed.
#pragma once

#include "sinew/mechanism/slide/setup.h"

namespace sinew::plant {

// Returns the set-up with the length at which the stand starts, and without valves where the air
// does not come by them. Throws std::invalid_argument for one that is no stand.
StandSetup prepared(const StandSetup& setup);

}  // namespace sinew::plant
