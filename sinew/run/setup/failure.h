// run/setup/failure.h - text of a failure of a simulated machine.
#pragma once

#include <string>

#include "sinew/actuator/actuator.h"
#include "sinew/air/failure.h"

namespace sinew::run {

// Returns "the air of muscle knee_flexor was not finite at 0.012 s: …; try …". `who` is the
// muscle's name in its file, `step` the key of the step's length.
std::string to_text(const air::Failure& failure, const std::string& who,
                    const actuator::Actuator& actuator, const std::string& step);

}  // namespace sinew::run
