// experiment/check.h - what each value allows, but not all of them together.
#pragma once

#include <string_view>
#include <vector>

#include "sinew/experiment/experiment.h"

namespace sinew::experiment {

// Throws config::Error with all that contradicts itself in what a file of that kind says.
void refuse_contradictions(std::string_view kind, const Experiment& experiment);

// Adds what a test stand's values contradict.
void check_stand(const Experiment& experiment, std::vector<robot::Contradiction>& wrong);

// Throws config::Error with what is wrong, each where its key stands; nothing where nothing is.
void refuse(const std::vector<robot::Contradiction>& wrong, const Experiment& experiment);

}  // namespace sinew::experiment
