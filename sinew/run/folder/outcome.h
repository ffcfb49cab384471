// run/folder/outcome.h - messages about a run that neither its figures nor its log contain.
#pragma once

#include <string>
#include <vector>

#include "sinew/run/simulation/run.h"

namespace sinew::run {

// Returns a sentence for each kind of lateness on this computer, for rejected readings without a
// channel of their own, and for faults that never acted.
std::vector<std::string> warnings_outside_log(const experiment::Experiment& experiment,
                                              const run::Outcome& outcome);

// Returns why the run ended early, with the last record of every topic.
std::string last_records(const experiment::Experiment& experiment, const run::Outcome& outcome);

}  // namespace sinew::run
