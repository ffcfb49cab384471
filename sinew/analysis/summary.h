// analysis/summary.h - from a log to a run in numbers.
#pragma once

#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/verdict/summary.h"
#include "sinew/signals/table.h"

namespace sinew::analysis {

// Returns the figures of a whole run, and its warnings.
Summary summarize(const signals::Table&, const Machine&);

// Returns the counts and the cause of a run that its supervisor ended, without a whole run's
// figures.
Summary summarize_trip(const signals::Table&, const Machine&);

}  // namespace sinew::analysis
