// identify/fit/report_json.h - a report for programs, as `sinew identify --json` prints it.
#pragma once

#include "sinew/identify/fit/fit.h"
#include "sinew/json/json.h"

namespace sinew::identify {

// Returns format sinew.identification/1: the report with its models, and the chosen one once more
// where a program looks first. Values are in the units that stand beside them; what is not known,
// as the interval of a value at its bound, is null.
Json to_json(const Report& report);

// Returns the value, or null where it is not finite: JSON has no infinity.
Json finite_or_null(double value);

}  // namespace sinew::identify
