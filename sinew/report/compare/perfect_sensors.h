// report/compare/perfect_sensors.h - what a sensor without error would have read, for runs that
// are held against a measurement of it.
#pragma once

#include <vector>

#include "sinew/signals/table.h"

namespace sinew::report {

// A simulation knows pressures and lengths that its robot has no sensor for, under /true; a
// recording that measured them has them without it. Every table that lacks a topic which another
// one has, and has it under /true, gets a copy under the plain name. A table that has neither stays
// as it is.
void add_perfect_sensors(const std::vector<signals::Table*>& tables);

}  // namespace sinew::report
