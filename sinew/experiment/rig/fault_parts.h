// experiment/rig/fault_parts.h - the parts of a test stand that the list [[fault]] can break: those
// of its air.
#pragma once

#include <vector>

#include "sinew/experiment/fault_parts.h"
#include "sinew/experiment/rig/rig.h"

namespace sinew::rig {

// Returns the element's muscle as "bpa", where its air comes by valves also "bpa.inlet",
// "bpa.exhaust" and "supply"; the stand's transducers, so that they can be refused. None where the
// pressure is prescribed: nothing that breaks would change it.
std::vector<experiment::FaultPart> fault_parts(const Experiment& experiment);

}  // namespace sinew::rig
