#include "sinew/analysis/measures/foot.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew::analysis {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double come_back = 0.1;  // least return after a peak, as a share of the way [-]

// Returns the row at which `values` first cross `level` in a direction, interpolated linearly; NaN
// if they do not.
double crossing(std::span<const double> values, double level, double direction) {
  for (std::size_t i = 0; i + 1 < values.size(); ++i) {
    const double a = direction * (values[i] - level), b = direction * (values[i + 1] - level);
    if (a <= 0 && b > 0) return static_cast<double>(i) + a / (a - b);
  }
  return none;
}

}  // namespace

double slip_velocity(const robot::TwoLinks& links, std::array<double, 2> angle,
                     std::array<double, 2> rate, double radius, double trolley_velocity) {
  const robot::Jacobian j = robot::jacobian(links, angle[0], angle[1]);
  return trolley_velocity + j.x1 * rate[0] + j.x2 * rate[1] + radius * (rate[0] + rate[1]);
}

double repeat_rms(std::span<const Path> paths, std::span<const double> weights) {
  return repeat_rms(
      paths.size(), [&](std::size_t i) { return paths[i]; }, weights);
}

double repeat_rms(std::size_t paths, const PathOf& path_of, std::span<const double> weights) {
  if (paths < 2) return none;
  const double n = static_cast<double>(paths);
  Path middle(weights.size());
  for (std::size_t i = 0; i < paths; ++i) {
    const Path path = path_of(i);
    for (std::size_t k = 0; k < middle.size(); ++k) {
      middle[k].x += path[k].x / n;
      middle[k].y += path[k].y / n;
    }
  }

  // Sums the squared distances from the mean by point; NaN if any path is NaN there.
  std::vector<double> spread(weights.size(), 0.0);
  for (std::size_t i = 0; i < paths; ++i) {
    const Path path = path_of(i);
    for (std::size_t k = 0; k < middle.size(); ++k) {
      const double dx = path[k].x - middle[k].x, dy = path[k].y - middle[k].y;
      spread[k] += dx * dx + dy * dy;
    }
  }
  double sum = 0, weight = 0;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    if (!std::isfinite(spread[k])) continue;
    sum += weights[k] * spread[k];
    weight += weights[k];
  }
  return weight > 0 ? std::sqrt(sum / (weight * n)) : none;
}

std::vector<double> at_progress(const signals::Column& values, std::size_t first, std::size_t last,
                                int points) {
  std::vector<double> out;
  for (int k = 0; k < points; ++k) {
    const double rows = static_cast<double>(last - first) * (k + 0.5) / points;
    const std::size_t i = first + static_cast<std::size_t>(rows);
    const std::size_t next = std::min(i + 1, values.size() - 1);
    const double share = rows - std::floor(rows);
    out.push_back(values[i] + share * (values[next] - values[i]));
  }
  return out;
}

double ten_to_ninety(std::span<const double> values, double target, double period) {
  if (values.empty()) return none;
  const double start = values.front(), way = target - start, direction = way > 0 ? 1 : -1;
  const double ten = crossing(values, start + 0.1 * way, direction);
  const double ninety = crossing(values, start + 0.9 * way, direction);
  return (ninety - ten) * period;
}

Rise rise(std::span<const double> values, double period) {
  if (values.size() < 3) return {};
  const double start = values.front();

  // The direction is that of the farthest value.
  double farthest = 0;
  for (const double v : values)
    if (std::abs(v - start) > std::abs(farthest)) farthest = v - start;
  if (farthest == 0) return {};
  const double direction = farthest > 0 ? 1 : -1;

  // The first peak beyond half of the farthest value with a return; without one, the farthest
  // value.
  std::size_t peak = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double way = direction * (values[peak] - start);
    if (direction * (values[i] - start) > way) peak = i;
    const double back = direction * (values[peak] - values[i]);
    if (way > 0.5 * std::abs(farthest) && back > come_back * way) break;
  }
  const double partial = ten_to_ninety(values.first(peak + 1), values[peak], period);
  return {.partial = partial,
          .whole = static_cast<double>(peak) * period,
          .found = std::isfinite(partial)};
}

}  // namespace sinew::analysis
