// experiment/check.h - checks of an experiment for values that contradict each other, although each
// is in its range.
#pragma once

#include <string_view>
#include <vector>

#include "sinew/experiment/experiment.h"

namespace sinew::experiment {

// Throws config::Error with all contradictions among the values of a file of that kind.
void refuse_contradictions(std::string_view kind, const Experiment& experiment);

// Adds the contradictions among a test stand's values.
void check_stand(const Experiment& experiment, std::vector<robot::Contradiction>& wrong);

// Throws config::Error with the contradictions, each at the place of its key; does nothing if there
// are none.
void refuse(const std::vector<robot::Contradiction>& wrong, const Experiment& experiment);

}  // namespace sinew::experiment
