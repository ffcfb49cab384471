// identify/task/further.h - what a further measurement would buy: of each muscle that was fitted,
// the mounts that a plan would add (identify/plan/plan.h).
#pragma once

#include <optional>
#include <vector>

#include "sinew/identify/actuator/static.h"
#include "sinew/identify/fit/evidence.h"

namespace sinew::identify {

// Returns the three mounts that lower the error most, with the errors that are expected before and
// after each; none of a muscle whose points are too few for a plan. They are those of
// `sinew identify plan DATA --error "1.05 %" --most 3`.
std::vector<Further> further_measurements(const StaticResult& result, double atmosphere,
                                          const std::optional<actuator::Braid>& braid);

}  // namespace sinew::identify
