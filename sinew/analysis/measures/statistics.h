// analysis/measures/statistics.h - means over time of samples that may be missing, and what is left
// without a moving mean.
//
// Sample i holds for seconds[i]; 0 leaves it out. Samples that are not a number are left out too.
// With no sample left the result is not a number, and a summary leaves its key out.
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

// How often something turns round, and how far it swings in
// between.
//
//   turning point   an extreme that the values have come to by at least `back` and have come back
//                   from by at least `back`
//   half swing      from one turning point to the next; its amplitude is half of its height
//
// The ends of the values are no turning points, so a ramp has none, whatever its corners, and a
// deviation that grows once and dies away has one, which is no swing. A sine of n periods that
// starts at zero has 2 n, if its amplitude is at least `back`. What is smaller than `back`, such as
// noise, is passed over. So is an oscillation on a slope so steep that it never turns round.

// Where a series stops rising or falling.
struct TurningPoint {
  std::size_t row = 0;  // the first one with that value
  double value = 0;
};

// In ascending rows, maxima and minima by turns. `back` > 0, in the unit of the values; values that
// are not a number are passed over.
std::vector<TurningPoint> turning_points(std::span<const double> values, double back);

// Amplitudes of the half swings between turning points, in their order; one fewer than there are
// points, and none for fewer than two.
std::vector<double> amplitudes(const std::vector<TurningPoint>& points);

}  // namespace sinew::analysis
