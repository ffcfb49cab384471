// thesis/figures/chapter_2.h - figures of chapter 2 that come from the test stand.
#pragma once

#include "thesis/figures/thesis.h"

namespace sinew::thesis {

// Returns 2-8 to 2-12: weights hung on an actuator with its air sealed in, compared with the laws.
Exhibits weights(const Sources& from);

// Adds to 2-13 a run in which the stand stretches the actuator.
void add_length_sweep(const Sources& from, Exhibit& figure_2_13);

}  // namespace sinew::thesis
