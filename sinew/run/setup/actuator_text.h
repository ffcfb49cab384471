// run/setup/actuator_text.h - an actuator's operating points as text and as JSON.
#pragma once

#include <string>
#include <vector>

#include "sinew/actuator/operating_point.h"
#include "sinew/units/shown.h"

namespace sinew::run {

// Returns one point as lines of text: each quantity in SI, and in inches and pounds; or only in the
// units of `shown`. A value that the law does not give is a dash; an optional value that was not
// requested is left out.
std::string text_of(const actuator::OperatingPoint& point,
                    const units::ShownUnits* shown = nullptr);

// Returns at least one point as a table with a line per point. `length` and `pressure` are the
// units of those columns, for instance "in" and "psi gauge". With `shown`, all columns are in its
// units. A star marks a point beyond the range of the model.
std::string table_of(const std::vector<actuator::OperatingPoint>& points, const std::string& length,
                     const std::string& pressure, const units::ShownUnits* shown = nullptr);

// Returns a JSON object, in SI, without values that are not finite.
std::string json_of(const actuator::OperatingPoint& point);

}  // namespace sinew::run
