// cli/thesis/chapter_6.h - what the text says of walking, beyond what summaries have.
#pragma once

#include "cli/thesis/leg_run.h"

namespace sinew::cli::thesis {

// Into 6-3 to 6-11.
void add_text_of_test_1(const LegRun& run, const Sources& from, Exhibits& out);

// rms of the hip's oscillation in the swing of that step, the first is 0  [deg].
double swing_oscillation(const LegRun& run, int step);

}  // namespace sinew::cli::thesis
