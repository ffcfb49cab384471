// identify/data/series.h - operations on time series: derivatives without lag, and delay.
#pragma once

#include <span>
#include <vector>

namespace sinew::identify {

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
