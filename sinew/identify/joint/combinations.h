// identify/joint/combinations.h - which products of a joint's parameters the data determine, and
// how well.
#pragma once

#include <vector>

#include "sinew/identify/fit/least_squares.h"
#include "sinew/identify/joint/joint.h"

namespace sinew::identify {

// Returns the principal axes of the parameters' relative errors, best determined first, of those
// parameters that are positive and within their bounds.
std::vector<Combination> combinations_of(const Solution& solution);

}  // namespace sinew::identify
