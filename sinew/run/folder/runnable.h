// run/folder/runnable.h - everything that can be refused before a run, refused: `sinew run` begins
// with it, and `sinew check` is it, so that the two cannot disagree.
#pragma once

#include <string>
#include <vector>

#include "sinew/experiment/experiment.h"

namespace sinew::run {

// Returns an experiment whose machine, plan, controller, channels and what is reported of it were
// all looked at. `sets` are "key=value" in place of the file's. Throws config::Error by the files'
// own lines; with `allow_unreachable` a foot path may leave the reach.
experiment::Experiment runnable(const std::string& path, const std::vector<std::string>& sets,
                                bool allow_unreachable);

}  // namespace sinew::run
