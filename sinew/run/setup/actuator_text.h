// run/setup/actuator_text.h - an actuator's operating points for people and for programs.
#pragma once

#include <string>
#include <vector>

#include "sinew/actuator/operating_point.h"
#include "sinew/units/shown.h"

namespace sinew::run {

// Returns one point as lines of text: each quantity in SI, and in inches and pounds; or in `shown`
// alone, where somebody asked for some. What the law gives no number for is a dash; what was not
// asked for is left out.
std::string text_of(const actuator::OperatingPoint& point,
                    const units::ShownUnits* shown = nullptr);

// Returns points as a table, a line each; `length` and `pressure` are the units of those columns,
// "in" and "psi gauge" for instance. With `shown` all columns are in its units. A star marks a
// point that is beyond the model. At least one.
std::string table_of(const std::vector<actuator::OperatingPoint>& points, const std::string& length,
                     const std::string& pressure, const units::ShownUnits* shown = nullptr);

// Returns an object of JSON, in SI, without what is no number.
std::string json_of(const actuator::OperatingPoint& point);

}  // namespace sinew::run
