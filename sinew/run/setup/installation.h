// run/setup/installation.h - an experiment as what its low level is set up for (control/setup).
#pragma once

#include "sinew/control/setup/installation.h"
#include "sinew/experiment/experiment.h"

namespace sinew::run {

control::Installation installation(const experiment::Experiment& experiment);

}  // namespace sinew::run
