// identify/data/series.h - operations on series: straight lines, derivatives without lag, delay.
#pragma once

#include <span>
#include <vector>

namespace sinew::identify {

// Straight line of y over x by least squares, with the sums that it follows from.
struct StraightLine {
  double x = 0, y = 0;    // means
  double xx = 0, xy = 0;  // sums of (x - mean)^2 and of (x - mean) (y - mean)

  // Returns the slope; 0 if all x are equal.
  double slope() const { return xx > 0 ? xy / xx : 0; }
  double at(double where) const { return y + slope() * (where - x); }
};

// Returns the line through the points.
StraightLine line_through(std::span<const double> x, std::span<const double> y);

// First and second derivative of a series.
struct Rates {
  std::vector<double> first, second;  // per second, per second squared
};

// Returns the derivatives at each sample, of the least squares parabola through the samples within
// `window`/2 [s], at least two on either side.
Rates rates_of(std::span<const double> time, std::span<const double> values, double window);

// Writes the values at `time` - `delay` of a series sampled at `time`: cubic between samples,
// constant beyond its ends.
void delayed(std::span<const double> time, std::span<const double> values, double delay,
             std::span<double> out);

}  // namespace sinew::identify
