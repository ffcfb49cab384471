// analysis/measures/rain_flow.h - cycles of a series that rises and falls, counted by rain flow.
//
// The method of ASTM E1049-85, section 5.4.4: of three successive turning points the range between
// the first two is compared with the range between the last two. A range that is no larger than the
// next one is a cycle within the larger motion, and its two turning points are removed. If
// a range begins at the first point left, it is half a cycle, and that point is removed. The ranges
// left at the end are half cycles.
//
//   range   |difference| of the two turning points        mean   their mean
//   count   1, or 0.5 for half a cycle
//
// Counts depend on the order of the turning points alone, not on time. Each turning point, the
// series' two ends included, is in one cycle: their number is 1 + 2 sum count.
#pragma once

#include <vector>

#include "sinew/signals/table.h"

namespace sinew::analysis {

struct Cycle {
  double range = 0, mean = 0;  // in the unit of the values
  double count = 0;            // 1, or 0.5 for half a cycle
};

// Returns the cycles whose range is at least `least`, in the order in which they close. Smaller
// ones are noise, a count of the sensor. NaN values are skipped.
std::vector<Cycle> rain_flow(const signals::Column& values, double least = 0);

// Returns the number of cycles, and the largest range; 0 without any.
double cycles_in(const std::vector<Cycle>& cycles);
double largest_range(const std::vector<Cycle>& cycles);

}  // namespace sinew::analysis
