// analysis/measures/oscillation.h - how often something turns round, and how far it swings in
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
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace sinew::analysis {

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
