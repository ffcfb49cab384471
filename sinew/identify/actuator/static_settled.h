// identify/actuator/static_settled.h - samples of a recording at which the pressure rests: while a
// valve lets air in or out, the pressure at the sensor differs from that in the muscle.
#pragma once

#include <span>
#include <vector>

namespace sinew::identify {

// Samples that have settled, and the criterion.
struct Settled {
  std::vector<bool> sample;  // true for each settled sample
  double window = 0;         // time over which the change of pressure is measured [s]
  double most = 0;           // largest change over the window of a settled sample [Pa]
  int rests = 0;             // number of rests of at least a window

  // Returns the number of samples that have not settled.
  std::size_t moving() const;
};

// Finds settled samples. Times ascend [s], with one pressure [Pa] each. A sample has settled if
// the smoothed pressure changes over 0.12 s around it by at most 0.5 % of its range, or 6 times the
// scatter of the samples if that is more. The window holds at least three samples, so it is longer
// if samples are rare.
Settled settled_samples(std::span<const double> time, std::span<const double> pressure);

}  // namespace sinew::identify
