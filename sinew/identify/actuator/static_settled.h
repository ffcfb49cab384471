// identify/actuator/static_settled.h - which samples of a recording are at rest: while a valve lets
// air in or out, the pressure at the sensor is not yet the pressure in the muscle.
#pragma once

#include <span>
#include <vector>

namespace sinew::identify {

// Says which samples have settled, and by which measure.
struct Settled {
  std::vector<bool> sample;  // of each one: has it?
  double window = 0;         // over which the pressure is looked at  [s]
  double most = 0;           // change over the window up to which a sample has settled  [Pa]
  int rests = 0;             // how many times it rests for at least a window

  // Returns how many samples have not.
  std::size_t moving() const;
};

// Times ascend [s], pressures [Pa], as many. A sample has settled where the pressure, smoothed,
// changes over 0.12 s around it by no more than 0.5 % of its whole range, or by no more than 6
// times the scatter of its samples where that is more. The window is longer where samples are rare:
// it holds three of them.
Settled settled_samples(std::span<const double> time, std::span<const double> pressure);

}  // namespace sinew::identify
