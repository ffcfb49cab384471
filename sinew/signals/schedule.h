// signals/schedule.h - a quantity over time: linear between points, constant after the last.
//
//   x(t) = x_i + (t - t_i) (x_i+1 - x_i)/(t_i+1 - t_i)
//
// Two points at one instant are a jump; the later one holds from there on. Before the first point
// its value holds. Times must ascend.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace sinew::signals {

struct Schedule {
  struct Point {
    double at = 0;     // [s]
    double value = 0;  // in the SI unit of the quantity
  };

  // One of the linear pieces.
  struct Piece {
    double from = 0, value = 0, slope = 0;

    // Returns its value at t.
    double at(double t) const { return value + (t - from) * slope; }
  };

  std::vector<Point> points;

  Schedule() = default;
  // Is constant; or has these points, in ascending time.
  Schedule(double constant) : points{{0.0, constant}} {}
  Schedule(std::vector<Point> p) : points(std::move(p)) {}

  bool empty() const { return points.empty(); }
  // Returns whether there is more than one point and t is not beyond the last.
  bool moves_until(double t) const noexcept { return points.size() > 1 && t <= points.back().at; }

  // Returns the piece that begins at t or holds there; 0 without points.
  Piece piece(double t) const noexcept {
    const std::size_t next = after(t);
    if (points.empty()) return {};
    if (next == 0) return {t, points[0].value, 0.0};
    const Point& p = points[next - 1];
    if (next == points.size()) return {p.at, p.value, 0.0};
    return {p.at, p.value, (points[next].value - p.value) / (points[next].at - p.at)};
  }

  // Returns its value at t.
  double at(double t) const noexcept { return piece(t).at(t); }

  // Returns the next point after t, or infinity [s].
  double corner(double t) const noexcept {
    const std::size_t next = after(t);
    return next < points.size() ? points[next].at : std::numeric_limits<double>::infinity();
  }

 private:
  // Returns the index of the first point later than t.
  std::size_t after(double t) const noexcept {
    std::size_t low = 0, high = points.size();
    while (low < high) {
      const std::size_t middle = (low + high) / 2;
      if (points[middle].at <= t)
        low = middle + 1;
      else
        high = middle;
    }
    return low;
  }
};

// Returns the points as steps: each value holds from its instant on.
inline std::vector<Schedule::Point> steps_of(const std::vector<Schedule::Point>& points) {
  std::vector<Schedule::Point> out;
  for (const Schedule::Point& p : points) {
    if (!out.empty()) out.push_back({p.at, out.back().value});
    out.push_back(p);
  }
  return out;
}

}  // namespace sinew::signals
