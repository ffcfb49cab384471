// identify/data/series.h - what is made of samples over time: rates that do not lag, and the same
// series a little later.
#pragma once

#include <span>
#include <vector>

namespace sinew::identify {

// How fast something changes, and how fast that does.
struct Rates {
  std::vector<double> first, second;  // per second, per second squared
};

// Returns slope and twice the bend, at each sample, of the parabola of least squares through the
// samples within `window`/2 of it, two on either side at least  [s].
Rates rates_of(std::span<const double> time, std::span<const double> values, double window);

// Writes the values at `time` - `delay` of a series that is sampled at `time`: cubic between
// samples, constant beyond its ends.
void delayed(std::span<const double> time, std::span<const double> values, double delay,
             std::span<double> out);

}  // namespace sinew::identify
