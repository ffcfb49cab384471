// analysis/measures/statistics.h - means over time, high pass and turning points of series that may
// have gaps.
//
// Sample i lasts for seconds[i]; 0 leaves it out. NaN samples are left out too. Without any sample
// the result is NaN, and a summary leaves out its key.
//
//   mean      sum x_i dt_i / sum dt_i
//   rms       sqrt of the mean of x^2
//   deviation sqrt of the mean of (x - mean)^2
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sinew/signals/table.h"

namespace sinew::analysis {

using Values = const signals::Column&;
using Seconds = const signals::Column&;

// Return statistics of a series, weighted with the duration of each value [s]; NaN if all durations
// are 0.
double mean(Values values, Seconds seconds);
double rms(Values values, Seconds seconds);
double deviation(Values values, Seconds seconds);
double smallest(Values values, Seconds seconds);
double largest(Values values, Seconds seconds);
double largest_magnitude(Values values, Seconds seconds);

// Returns the mean of the 2 half + 1 samples about each one; NaN nearer than `half` to either end.
signals::Column moving_mean(Values values, std::size_t half);

// Returns the values less their moving mean, a high pass without phase shift. A sine of period T
// sampled every dt keeps 1 - sin((2 half + 1) pi dt/T) / ((2 half + 1) sin(pi dt/T)) of its
// amplitude; constants and ramps vanish.
signals::Column high_passed(Values values, std::size_t half);

// Returns the samples on each side of a window of `width` seconds, sampled every `period`.
std::size_t half_window(double width, double period);

// Turning points of a series, and the swings between them.
//
//   turning point   an extreme: the values change by at least `back` before it, and by at least
//                   `back` in the other direction after it
//   half swing      from one turning point to the next; its amplitude is half of its height
//
// The ends of the series are no turning points: a ramp has none; a deviation that grows once and
// decays has one, and so no half swing. A sine of n periods that starts at zero has 2 n if its
// amplitude is at least `back`. Smaller changes, such as noise, are ignored, and so is an
// oscillation on a slope so steep that the sum is monotonic.

// An extreme of a series.
struct TurningPoint {
  std::size_t row = 0;  // the first one with that value
  double value = 0;
};

// Returns the turning points in ascending rows, maxima and minima alternating. `back` > 0 is in the
// unit of the values; NaN values are skipped.
std::vector<TurningPoint> turning_points(std::span<const double> values, double back);

// Returns the amplitudes of the half swings between turning points, in their order; empty for fewer
// than two points.
std::vector<double> amplitudes(const std::vector<TurningPoint>& points);

}  // namespace sinew::analysis
