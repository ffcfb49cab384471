#include "sinew/identify/sensor/points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "sinew/identify/data/quality.h"

namespace sinew::identify {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// Returns the distinct known values, ascending.
std::vector<double> levels_of(std::span<const double> known) {
  std::vector<double> sorted(known.begin(), known.end()), out;
  std::ranges::sort(sorted);
  const double tolerance = sorted.empty() ? 0 : 1e-6 * (sorted.back() - sorted.front());
  for (const double x : sorted)
    if (out.empty() || x > out.back() + tolerance) out.push_back(x);
  return out;
}

// Returns the direction from which each row's level was reached; first rows take that of the next.
std::vector<int> directions_of(const std::vector<std::size_t>& level) {
  std::vector<int> out(level.size(), 0);
  for (std::size_t i = 1; i < level.size(); ++i)
    out[i] = level[i] > level[i - 1] ? 1 : level[i] < level[i - 1] ? -1 : out[i - 1];
  const auto first = std::ranges::find_if(out, [](int d) { return d != 0; });
  std::fill(out.begin(), first, first == out.end() ? 1 : *first);
  return out;
}

struct Line {
  double at_zero = 0, slope = 0;
  bool known = false;
  double operator()(double x) const { return at_zero + slope * x; }
};

// Fits a line through the points whose outputs are strictly between the two limits.
Line line_between(std::span<const Point> points, double bottom, double top) {
  double n = 0, mx = 0, my = 0, xx = 0, xy = 0;
  const auto inside = [&](const Point& p) { return p.output > bottom && p.output < top; };
  for (const Point& p : points) {
    if (!inside(p)) continue;
    ++n;
    mx += p.known;
    my += p.output;
  }
  mx /= n;
  my /= n;
  for (const Point& p : points) {
    if (!inside(p)) continue;
    xx += (p.known - mx) * (p.known - mx);
    xy += (p.known - mx) * (p.output - my);
  }
  if (!(xx > 0)) return {};
  return {my - xy / xx * mx, xy / xx, true};
}

// Returns the points whose rows all read `value`.
std::vector<const Point*> resting_at(std::span<const Point> points, std::span<const double> output,
                                     double value, double tolerance) {
  std::vector<const Point*> out;
  for (const Point& p : points)
    if (std::ranges::all_of(
            p.rows, [&](std::size_t r) { return std::abs(output[r] - value) <= tolerance; }))
      out.push_back(&p);
  return out;
}

// Returns the largest expected change of the output among those points, by the line of the others.
double expected_change(const std::vector<const Point*>& points, const Line& line) {
  if (points.empty() || !line.known) return 0;
  return std::abs(line(points.back()->known) - line(points.front()->known));
}

// Returns the distances between neighbouring different readings, ascending.
std::vector<double> distances(std::span<const double> output) {
  std::vector<double> sorted(output.begin(), output.end()), out;
  std::ranges::sort(sorted);
  const double size = std::max(std::abs(smallest(output)), std::abs(largest(output)));
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (sorted[i] - sorted[i - 1] > 1e-9 * size) out.push_back(sorted[i] - sorted[i - 1]);
  std::ranges::sort(out);
  return out;
}

std::vector<std::size_t> rows_where(std::span<const double> output, auto&& says) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < output.size(); ++i)
    if (says(output[i])) out.push_back(i);
  return out;
}

}  // namespace

std::vector<Point> points_of(std::span<const double> known, std::span<const double> output) {
  const std::vector<double> levels = levels_of(known);
  std::vector<std::size_t> level;
  for (const double x : known)
    level.push_back(static_cast<std::size_t>(std::ranges::upper_bound(levels, x) - levels.begin()) -
                    1);
  const std::vector<int> direction = directions_of(level);

  std::map<std::pair<std::size_t, int>, Point> found;  // sorted by level, the ones from below first
  for (std::size_t i = 0; i < known.size(); ++i) {
    Point& p = found[{level[i], -direction[i]}];
    p.level = level[i];
    p.direction = direction[i];
    p.rows.push_back(i);
  }
  std::vector<Point> out;
  for (auto& [key, p] : found) {
    const auto n = static_cast<double>(p.rows.size());
    for (const std::size_t row : p.rows) {
      p.known += known[row] / n;
      p.output += output[row] / n;
    }
    out.push_back(std::move(p));
  }
  return out;
}

std::size_t level_count(std::span<const Point> points) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    count += i == 0 || points[i].level != points[i - 1].level;
  return count;
}

double step_of(std::span<const Point> points, std::span<const double> output) {
  const std::vector<double> steps = distances(output);
  if (steps.size() < 8) return none;  // too few different readings

  // Every distance is a whole number of steps, up to the rounding in the file.
  double total = 0, whole = 0;
  std::size_t odd = 0;
  for (const double d : steps) {
    const double guess = whole > 0 ? total / whole : d;
    const double count = std::round(d / guess);
    if (std::abs(d / guess - count) > 0.15) {
      ++odd;
      continue;
    }
    total += d;
    whole += count;
  }
  if (10 * odd > steps.size()) return none;  // random distances pass one time in three

  const double step = total / whole;
  std::vector<double> apart;
  for (std::size_t i = 1; i < points.size(); ++i)
    if (points[i].level != points[i - 1].level)
      apart.push_back(std::abs(points[i].output - points[i - 1].output));
  const bool fine = step < 0.5 * median(apart);
  const bool shared = 2 * (steps.size() + 1) <= level_count(points);
  return fine || shared ? step : none;
}

double noise_of(std::span<const Point> points, std::span<const double> output, double step) {
  double sum = 0;
  std::size_t freedom = 0;
  for (const Point& p : points) {
    for (const std::size_t row : p.rows) sum += std::pow(output[row] - p.output, 2);
    freedom += p.rows.size() - 1;
  }
  if (freedom < 3) return none;
  const double by_steps = std::isfinite(step) ? step * step / 12 : 0;
  return std::sqrt(std::max(0.0, sum / static_cast<double>(freedom) - by_steps));
}

Hysteresis hysteresis_of(std::span<const Point> points, double noise) {
  Hysteresis out{none, none};
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point &up = points[i - 1], &down = points[i];
    const bool turning = up.level == points.front().level || up.level == points.back().level;
    if (up.level != down.level || turning) continue;
    const double apart = std::abs(up.output - down.output);
    if (apart < out.largest) continue;
    out.largest = apart;
    out.by_noise = 3 * noise *
                   std::sqrt(1.0 / static_cast<double>(up.rows.size()) +
                             1.0 / static_cast<double>(down.rows.size()));
  }
  return out;
}

Ends ends_of(std::span<const Point> points, std::span<const double> output, double step,
             double top) {
  Ends out{.top = largest(output), .bottom = smallest(output)};
  const double finest = std::isfinite(step) ? step : 0;
  const double tolerance = std::max(0.01 * finest, 1e-9 * (out.top - out.bottom));
  const Line others = line_between(points, out.bottom + tolerance, out.top - tolerance);

  // Several points with one value although they should be some steps apart.
  const double noticeable = std::max(4 * finest, 0.01 * (out.top - out.bottom));
  const auto pinned = [&](double value) {
    return expected_change(resting_at(points, output, value, tolerance), others) > noticeable;
  };
  const bool top_pinned = pinned(out.top), bottom_pinned = pinned(out.bottom);

  const auto below_zero = [&](const Point& p) {
    return out.bottom <= tolerance && p.output <= out.bottom + tolerance && others.known &&
           others(p.known) < -noticeable;
  };
  const bool cut_at_zero = std::ranges::any_of(points, below_zero);

  out.at_top = rows_where(output, [&](double v) {
    return v >= top - tolerance || (top_pinned && v >= out.top - tolerance);
  });
  if (bottom_pinned || cut_at_zero)
    out.at_bottom = rows_where(output, [&](double v) { return v <= out.bottom + tolerance; });
  return out;
}

}  // namespace sinew::identify
