// run/stand/faulty_setup.h - the stand of an experiment with what breaks while it runs.
#pragma once

#include "sinew/experiment/rig/rig.h"

namespace sinew::rig {

// Returns rig::setup_of with the faults of the list [[fault]]. Expects a list without
// contradictions.
plant::StandSetup faulty_setup_of(const Experiment& experiment);

// Throws config::Error where there are more faults than an air network schedules.
void refuse_too_many_faults(const Experiment& experiment);

}  // namespace sinew::rig
