// experiment/check.h - what each value allows, but not all of them together.
#pragma once

#include <string_view>

#include "sinew/experiment/experiment.h"

namespace sinew::experiment {

// Throws config::Error with all that contradicts itself in what a file of that kind says.
void refuse_contradictions(std::string_view kind, const Experiment& experiment);

}  // namespace sinew::experiment
