// run/folder/runnable.h - all checks of an experiment before a run. `sinew run` and `sinew check`
// both use them, so that the two agree.
#pragma once

#include <string>
#include <vector>

#include "sinew/experiment/experiment.h"

namespace sinew::run {

// Returns an experiment whose machine, plan, controller, channels and reported values were checked.
// `sets` are "key=value" and override the file's. Throws config::Error with the lines of the files;
// with `allow_unreachable` a foot path may leave the reach.
experiment::Experiment runnable(const std::string& path, const std::vector<std::string>& sets,
                                bool allow_unreachable);

}  // namespace sinew::run
