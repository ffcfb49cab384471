// experiment/rig/check.h - what each value allows, but not all of them together.
#pragma once

#include "sinew/experiment/rig/rig.h"

namespace sinew::rig {

// Throws config::Error with all that contradicts itself.
void refuse_contradictions(const Experiment& experiment);

}  // namespace sinew::rig
