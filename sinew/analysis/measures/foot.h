// analysis/measures/foot.h - slip of the foot, repeatability of its steps, speed of its kick.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "sinew/robot/kinematics.h"
#include "sinew/signals/table.h"

namespace sinew::analysis {

// Returns the velocity of the lowest point of the foot's disc along the ground  [m/s]:
//
//   s' = x' + J_x theta' + r (theta_1' + theta_2')                                     [72]
//
// x' of the trolley, J_x the first row of [72], r the foot's radius: the disc turns with the last
// link.
double slip_velocity(const robot::TwoLinks& links, std::array<double, 2> angle,
                     std::array<double, 2> rate, double radius, double trolley_velocity);

using Path = std::vector<robot::Point>;

// Returns the root mean square distance of the paths from their mean, point by point  [m]:
//
//   sqrt( sum_k w_k sum_i |p_ik - mean_k|^2 / (n sum_k w_k) )     i of n paths, k of the points
//
// Points that are NaN in any path are left out. Returns NaN for fewer than two paths.
double repeat_rms(std::span<const Path> paths, std::span<const double> weights);

// Returns the same for a number of paths. path_of() is called twice for each, in ascending order,
// so that one path at a time is in memory.
using PathOf = std::function<Path(std::size_t path)>;
double repeat_rms(std::size_t paths, const PathOf& path_of, std::span<const double> weights);

// Returns the values at the progress (k + 1/2)/points of rows first .. last, interpolated linearly.
std::vector<double> at_progress(const signals::Column& values, std::size_t first, std::size_t last,
                                int points);

// Returns the time from 10 to 90 % of the way from the first value to `target`, interpolated
// linearly between rows  [s]; NaN if 90 % is not reached.
double ten_to_ninety(std::span<const double> values, double target, double period);

// A motion from its start to its first peak, after which it returns by more than a tenth of the
// way.
struct Rise {
  double partial = 0;  // time from 10 to 90 % of the way to the peak [s]
  double whole = 0;    // time from the start to the peak [s]
  bool found = false;
};
Rise rise(std::span<const double> values, double period);

}  // namespace sinew::analysis
