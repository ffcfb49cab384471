// identify/actuator/static_widen.h - intervals of a static fit whose points scatter differently.
#pragma once

#include <cstddef>
#include <span>

#include "sinew/identify/fit/least_squares.h"

namespace sinew::identify {

// Scatter differs from point to point: a length that is 0.1 mm off matters most where force is
// steepest. Each point's own residual says how much (White's errors, with HC3's factor for the pull
// that a point has on its own fit). Intervals that this makes wider become so; none narrower.
//
// The first `points` of `count` residuals are measurements, the others what is known beforehand. A
// residual beyond `outlier` scatters counts as that many.
void widen(const Residuals& residuals, std::span<const Parameter> parameters, std::size_t count,
           std::size_t points, double scatter, double outlier, Solution& solution);

}  // namespace sinew::identify
