#include "sinew/control/gait/path.h"

#include <algorithm>
#include <cmath>

namespace sinew::gait {
namespace {

double coordinate(const Coordinate& c, double s, double x) noexcept {
  if (c.polynomial.empty()) return c.from + (c.to - c.from) * s;
  return polynomial_at(c.polynomial, c.of == Coordinate::Of::x ? x : s);
}

double side(const Points& p, std::size_t i) noexcept {
  return std::hypot(p.x[i + 1] - p.x[i], p.y[i + 1] - p.y[i]);
}

robot::Point between(const Points& p, std::size_t i, double share) noexcept {
  return {p.x[i] + (p.x[i + 1] - p.x[i]) * share, p.y[i] + (p.y[i + 1] - p.y[i]) * share};
}

// Returns the point at the share s of the polyline's length.
robot::Point along(const Points& p, double s) noexcept {
  const std::size_t n = std::min(p.x.size(), p.y.size());
  if (n == 0) return {};

  double length = 0;
  for (std::size_t i = 0; i + 1 < n; ++i) length += side(p, i);

  double left = s * length;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double here = side(p, i);
    if (left < here) return between(p, i, left / here);
    left -= here;
  }
  return {p.x[n - 1], p.y[n - 1]};
}

}  // namespace

double value_at(const Profile& profile, double s, double otherwise) noexcept {
  if (profile.empty()) return otherwise;
  const std::size_t last = profile.size() - 1;
  const double at = std::clamp(s, 0.0, 1.0) * static_cast<double>(last);
  const std::size_t i = std::min(static_cast<std::size_t>(at), last);
  if (i == last) return profile[last];
  return profile[i] + (profile[i + 1] - profile[i]) * (at - static_cast<double>(i));
}

double polynomial_at(const Profile& c, double u) noexcept {
  double sum = 0;
  for (auto k = c.rbegin(); k != c.rend(); ++k) sum = *k + u * sum;
  return sum;
}

double correction(const GroundForce& g, double normal_force) noexcept {
  const double wanted = g.gain * (normal_force - g.desired);
  return std::isfinite(wanted) ? std::clamp(wanted, -g.limit, g.limit) : 0.0;
}

robot::Point foot_at(const Phase& phase, double s) noexcept {
  const double inside = std::clamp(s, 0.0, 1.0);
  if (phase.points.given()) return along(phase.points, inside);
  const double x = coordinate(phase.x, inside, 0);
  return {x, coordinate(phase.y, inside, x)};
}

}  // namespace sinew::gait
