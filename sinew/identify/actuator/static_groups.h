// identify/actuator/static_groups.h - which points of a static test belong together: those of one
// pressure, of one length; and how they are shown.
#pragma once

#include <optional>
#include <vector>

#include "sinew/identify/actuator/static_data.h"
#include "sinew/identify/actuator/static_model.h"
#include "sinew/identify/fit/fit.h"

namespace sinew::identify {

// The points that are fitted, and those that judge.
struct StaticSplit {
  std::vector<StaticPoint> fitted, held_out;
};

// Parts the points: those whose index `keep` takes are fitted.
template <class Keep>
StaticSplit split(const std::vector<StaticPoint>& points, Keep keep) {
  StaticSplit out;
  for (std::size_t i = 0; i < points.size(); ++i)
    (keep(i) ? out.fitted : out.held_out).push_back(points[i]);
  return out;
}

// Returns the sizes that start values and bounds go by: those of the points.
StaticScales scales_of(const std::vector<StaticPoint>& points, double atmosphere,
                       const std::optional<actuator::Braid>& braid);

// Of each point its group, counted from the smallest.
std::vector<int> pressure_groups(const std::vector<StaticPoint>& points);
// Lengths of different muscles are different lengths.
std::vector<int> length_groups(const std::vector<StaticPoint>& points);
int count_of(const std::vector<int>& groups);

// Returns the setting of each point, counted from 0: readings of one muscle and branch whose
// lengths and pressures differ by what a mount and a gauge leave open. Together they are as much
// evidence about a law as one of them, however many they are.
std::vector<int> setting_groups(const std::vector<StaticPoint>& points);

// Returns the lengths of a muscle's mounts in ascending order, each the mean of its readings, the
// first and the last the shortest and the longest reading of all  [m]. Empty: it has no point.
std::vector<double> lengths_of(const std::vector<StaticPoint>& points, double rest_length);

// The fitted points, then the others.
std::vector<StaticPoint> all_points(const StaticSplit& split);

// The fitted ones, then the others: over pressure with a curve per length, or over length with a
// curve per pressure, whichever makes fewer.
Rows rows_of(const StaticSplit& split);

}  // namespace sinew::identify
