// identify/machine/run_file.h - what a fit of a run has found, as a robot's file and as numbers.
#pragma once

#include <string>

#include "sinew/config/node.h"
#include "sinew/identify/machine/run_fit.h"
#include "sinew/json/json.h"

namespace sinew::identify {

// Returns the text of a robot's file: `robot` with the keys that were found, each with its source
// and how far it can be trusted. What the run does not determine is left out.
std::string run_file(const RunFitResult& found, const std::string& source, config::Node robot);

// Returns what the report does not say: channels, what is not determined, and what it took.
Json describe(const RunFitResult& found);

}  // namespace sinew::identify
