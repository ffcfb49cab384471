#include "sinew/analysis/measures/oscillation.h"

#include <cmath>

namespace sinew::analysis {

std::vector<TurningPoint> turning_points(std::span<const double> values, double back) {
  std::vector<TurningPoint> out;
  TurningPoint top, bottom;  // the extremes since the last turning point
  int direction = 0;         // in which the values go: up, down, 0 before they have gone anywhere
  bool first = true;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const TurningPoint now{i, values[i]};
    if (!std::isfinite(now.value)) continue;
    if (first || now.value > top.value) top = now;
    if (first || now.value < bottom.value) bottom = now;
    first = false;

    // A turn is known once the values have come back from it; the other extreme begins here.
    if (direction >= 0 && top.value - now.value >= back) {
      if (direction > 0) out.push_back(top);
      direction = -1;
      bottom = now;
    } else if (direction <= 0 && now.value - bottom.value >= back) {
      if (direction < 0) out.push_back(bottom);
      direction = 1;
      top = now;
    }
  }
  return out;
}

std::vector<double> amplitudes(const std::vector<TurningPoint>& points) {
  std::vector<double> out;
  for (std::size_t i = 1; i < points.size(); ++i)
    out.push_back(0.5 * std::abs(points[i].value - points[i - 1].value));
  return out;
}

}  // namespace sinew::analysis
