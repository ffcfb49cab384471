// thesis/figures/chapter_6.h - what the text says of walking, beyond what summaries have.
#pragma once

#include "thesis/figures/leg_run.h"

namespace sinew::thesis {

// Into 6-3 to 6-11.
void add_text_of_test_1(const LegRun& run, const Sources& from, Exhibits& out);

// Largest amplitude of a joint's half swings in the swing of that step, the first is 0; 0 where it
// does not turn twice (analysis/measures/statistics.h)  [deg].
double swing_amplitude(const LegRun& run, const std::string& joint, int step);

}  // namespace sinew::thesis
