// identify/actuator/static_groups.h - grouping of the points of a static test by pressure, length
// and setting, and their rows in a report.
#pragma once

#include <optional>
#include <vector>

#include "sinew/identify/actuator/static_data.h"
#include "sinew/identify/actuator/static_model.h"
#include "sinew/identify/contest/fit.h"

namespace sinew::identify {

// Points that are fitted, and points that test the fit.
struct StaticSplit {
  std::vector<StaticPoint> fitted, held_out;
};

// Splits the points: those whose index satisfies `keep` are fitted.
template <class Keep>
StaticSplit split(const std::vector<StaticPoint>& points, Keep keep) {
  StaticSplit out;
  for (std::size_t i = 0; i < points.size(); ++i)
    (keep(i) ? out.fitted : out.held_out).push_back(points[i]);
  return out;
}

// Returns the scales of start values and bounds, from the points.
StaticScales scales_of(const std::vector<StaticPoint>& points, double atmosphere,
                       const std::optional<actuator::Braid>& braid);

// Returns the group of each point, counted from the smallest pressure.
std::vector<int> pressure_groups(const std::vector<StaticPoint>& points);
// Returns the group of each point by length; different muscles have different groups.
std::vector<int> length_groups(const std::vector<StaticPoint>& points);
int count_of(const std::vector<int>& groups);

// Returns the setting of each point, counted from 0: readings of one muscle and branch whose
// lengths and pressures differ within the accuracy of a mount and a gauge. Readings of one setting
// together count as a single piece of evidence about a law.
std::vector<int> setting_groups(const std::vector<StaticPoint>& points);

// Returns the lengths of a muscle's mounts in ascending order [m], each the mean of its readings;
// the first and last are the shortest and longest reading. Empty if the muscle has no points.
std::vector<double> lengths_of(const std::vector<StaticPoint>& points, double rest_length);

// Returns the fitted points, then the others.
std::vector<StaticPoint> all_points(const StaticSplit& split);

// Returns the rows of a report, the fitted points first: over pressure with a curve per length, or
// over length with a curve per pressure, whichever gives fewer curves.
Rows rows_of(const StaticSplit& split);

}  // namespace sinew::identify
