// thesis/figures/chapter_6.h - statements of the text about walking that summaries do not cover.
#pragma once

#include "thesis/figures/leg_run.h"

namespace sinew::thesis {

// Adds the statements to 6-3 to 6-11.
void add_text_of_test_1(const LegRun& run, const Sources& from, Exhibits& out);

// Returns the largest amplitude of a joint's half swings in the swing of a step (the first is 0)
// [deg]; 0 if it does not turn twice (analysis/measures/statistics.h).
double swing_amplitude(const LegRun& run, const std::string& joint, int step);

}  // namespace sinew::thesis
