// analysis/measures/statistics.h - means over time of samples that may be missing.
//
// Sample i holds for seconds[i]; 0 leaves it out. Samples that are not a number are left out too.
// With no sample left the result is not a number, and a summary leaves its key out.
//
//   mean      sum x_i dt_i / sum dt_i
//   rms       sqrt of the mean of x^2
//   deviation sqrt of the mean of (x - mean)^2
#pragma once

#include <cstddef>

#include "sinew/signals/table.h"

namespace sinew::analysis {

using Values = const signals::Column&;
using Seconds = const signals::Column&;

// Figures of a series by the time that each value holds [s]: rows of no time do not count. NaN
// where no row does.
double mean(Values values, Seconds seconds);
double rms(Values values, Seconds seconds);
double deviation(Values values, Seconds seconds);
double smallest(Values values, Seconds seconds);
double largest(Values values, Seconds seconds);
double largest_magnitude(Values values, Seconds seconds);

// Mean of the 2 half + 1 samples about each one; not a number nearer than `half` to either end.
signals::Column moving_mean(Values values, std::size_t half);

// What is left when that is removed: a high pass without phase shift. A sine of period T sampled
// every dt keeps 1 - sin((2 half + 1) pi dt/T) / ((2 half + 1) sin(pi dt/T)) of its amplitude;
// constants and ramps vanish.
signals::Column high_passed(Values values, std::size_t half);

// Samples on each side of a window of `width` seconds, sampled every `period`.
std::size_t half_window(double width, double period);

}  // namespace sinew::analysis
