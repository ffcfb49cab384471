// identify/check/curves.h - points of static data as curves of force over pressure, one for each
// muscle, length and branch.
#pragma once

#include <optional>
#include <vector>

#include "sinew/identify/actuator/static_data.h"

namespace sinew::identify {

// Force over pressure at one length, pressures ascending; readings at one pressure are averaged.
struct ForceCurve {
  double rest_length = 0, length = 0;  // [m]
  Branch branch = Branch::unknown;
  std::vector<double> pressure, force, gap;  // [Pa, N]; gap: range of the readings at that pressure
};

// Returns the curves. Lengths within 0.2 % and pressures within 1 % of the largest are equal.
std::vector<ForceCurve> curves_of(std::vector<StaticPoint> points);

// Earliest and latest reading of one muscle at one length, pressure and branch.
struct RepeatedReading {
  double first = 0, last = 0;  // [N]
};

// Returns the readings that are repeated, where the branch is known; points are in the order of
// reading. Equality is that of curves_of(), and equal lengths are within 0.02 %.
std::vector<RepeatedReading> repeated_readings(const std::vector<StaticPoint>& points);

// Returns the interpolated force of a curve; empty outside its pressures.
std::optional<double> force_at(const ForceCurve& curve, double pressure);

// Returns the gauge pressure at which the straight part of a curve starts from zero force [Pa];
// empty if fewer than three points pull.
std::optional<double> threshold_of(const ForceCurve& curve);

}  // namespace sinew::identify
