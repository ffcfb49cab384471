// identify/check/curves.h - the points of static data as curves of force over pressure, one of each
// muscle, length and branch.
#pragma once

#include <optional>
#include <vector>

#include "sinew/identify/actuator/static_data.h"

namespace sinew::identify {

// Force over pressure at one length, pressures rising; what was read at one pressure is averaged.
struct ForceCurve {
  double rest_length = 0, length = 0;  // [m]
  Branch branch = Branch::unknown;
  std::vector<double> pressure, force, gap;  // [Pa, N]; gap: between readings at that pressure
};

// Lengths within 0.2 % and pressures within 1 % of the largest are one.
std::vector<ForceCurve> curves_of(std::vector<StaticPoint> points);

// The force of a curve at a pressure, between its points; nothing beyond them.
std::optional<double> force_at(const ForceCurve& curve, double pressure);

// The gauge pressure at which a curve's straight part starts from zero force [Pa]; nothing where it
// has fewer than three points that pull.
std::optional<double> threshold_of(const ForceCurve& curve);

}  // namespace sinew::identify
