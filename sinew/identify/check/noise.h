// identify/check/noise.h - how far force readings of one state scatter.
#pragma once

#include "sinew/identify/check/recognised.h"

namespace sinew::identify {

// Returns it from the samples of recordings that have settled, each against a straight line through
// those of its neighbours that it rests with; else from readings of a table that repeat a length,
// pressure and branch, each against the others. The larger kind of data speaks.
ForceNoise force_noise(const CheckInput& input);

}  // namespace sinew::identify
