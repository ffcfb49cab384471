// thesis/figures/chapter_2.h - the figures of chapter 2 that the test stand gives.
#pragma once

#include "thesis/figures/thesis.h"

namespace sinew::thesis {

// 2-8 to 2-12: weights hung on an actuator with its air shut in, beside the laws.
Exhibits weights(const Sources& from);

// Into 2-13: the stand pulls the actuator out.
void add_length_sweep(const Sources& from, Exhibit& figure_2_13);

}  // namespace sinew::thesis
