// identify/actuator/static_explain.h - what would explain a point that no law does: a slipped
// decimal, another unit, the reading of another mount.
//
// Each explanation changes one thing of the point; one is told where the law of the other points
// has the changed force within 3 of their scatters and 1 % of the largest force. Where several do,
// the nearest is told.
#pragma once

#include <span>
#include <string>

#include "sinew/identify/actuator/static_fit.h"

namespace sinew::identify {

// Returns it in words; `fit` is the law of the other points, `points` are all of them, `scatter` is
// how far they lie from it  [N].
std::string explanation_of(const StaticPoint& point, const StaticFit& fit,
                           const StaticScales& scales, std::span<const StaticPoint> points,
                           double scatter);

}  // namespace sinew::identify
