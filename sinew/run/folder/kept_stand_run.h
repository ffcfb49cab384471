// run/folder/kept_stand_run.h - a run on the test stand and the folder that keeps it.
#pragma once

#include "sinew/analysis/stand.h"
#include "sinew/run/folder/kept_run.h"

namespace sinew::run {

// Runs an experiment of format sinew.rig and keeps it; `request.allow_unreachable` means nothing.
// Throws config::Error for what cannot be run, or kept, and std::runtime_error where the run ended
// early.
Kept<analysis::StandFile> run_on_stand(const RunRequest& request, const Notices& notices = {});

}  // namespace sinew::run
