// analysis/measures/foot.h - how the foot slides, how alike its steps are, how fast it kicks.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "sinew/robot/kinematics.h"
#include "sinew/signals/table.h"

namespace sinew::analysis {

// Velocity of the lowest point of the foot's disc along the ground  [m/s]:
//
//   s' = x' + J_x theta' + r (theta_1' + theta_2')                                     [72]
//
// x' of the trolley, J_x the first row of [72], r the foot's radius: the disc turns with the last
// link.
double slip_velocity(const robot::TwoLinks& links, std::array<double, 2> angle,
                     std::array<double, 2> rate, double radius, double trolley_velocity);

using Path = std::vector<robot::Point>;

// Root mean square distance of the paths from their mean, point by point  [m]:
//
//   sqrt( sum_k w_k sum_i |p_ik - mean_k|^2 / (n sum_k w_k) )     i of n paths, k of the points
//
// Points of which a path has no number are left out. Not a number for fewer than two paths.
double repeat_rms(std::span<const Path> paths, std::span<const double> weights);

// Does the same for so many paths, each asked for twice, in their order: they need not be there at
// once.
using PathOf = std::function<Path(std::size_t path)>;
double repeat_rms(std::size_t paths, const PathOf& path_of, std::span<const double> weights);

// Values at the progress (k + 1/2)/points of rows first .. last, straight between rows.
std::vector<double> at_progress(const signals::Column& values, std::size_t first, std::size_t last,
                                int points);

// From 10 to 90 % of the way from the first value to `target`, straight between rows  [s]. Not a
// number where 90 % are never reached.
double ten_to_ninety(std::span<const double> values, double target, double period);

// A motion away from where it starts, up to its first peak: the first row after which it comes
// back by more than a tenth of the way it has made.
struct Rise {
  double partial = 0;  // from 10 to 90 % of the way to the peak [s]
  double whole = 0;    // from the start to the peak [s]
  bool found = false;
};
Rise rise(std::span<const double> values, double period);

}  // namespace sinew::analysis
