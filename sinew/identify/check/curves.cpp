#include "sinew/identify/check/curves.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "sinew/identify/data/quality.h"

namespace sinew::identify {

namespace {

constexpr double one_length = 2e-4;    // share of the length: noise of equal readings
constexpr double one_pressure = 0.01;  // share of the largest pressure

// Returns the largest distance between readings of the same length; others also differ by length.
double gap_of(std::vector<StaticPoint> points) {
  std::ranges::stable_sort(points, {}, &StaticPoint::length);
  double out = 0;
  for (std::size_t i = 0; i < points.size();) {
    const double first = points[i].length;
    double low = points[i].force, high = low;
    for (; i < points.size() && points[i].length - first <= one_length * std::abs(first); ++i) {
      low = std::min(low, points[i].force);
      high = std::max(high, points[i].force);
    }
    out = std::max(out, high - low);
  }
  return out;
}

// Adds points at one pressure as their average.
void add(const std::vector<StaticPoint>& at_one, ForceCurve& curve) {
  double pressure = 0, force = 0;
  for (const StaticPoint& p : at_one) {
    pressure += p.pressure / static_cast<double>(at_one.size());
    force += p.force / static_cast<double>(at_one.size());
  }
  curve.pressure.push_back(pressure);
  curve.force.push_back(force);
  curve.gap.push_back(gap_of(at_one));
}

ForceCurve curve_of(std::vector<StaticPoint> points, double near) {
  std::stable_sort(points.begin(), points.end(), [](const StaticPoint& a, const StaticPoint& b) {
    return a.pressure < b.pressure;
  });
  ForceCurve out{points[0].rest_length, points[0].length, points[0].branch, {}, {}, {}};
  std::vector<StaticPoint> at_one;
  for (const StaticPoint& p : points) {
    if (!at_one.empty() && p.pressure - at_one[0].pressure > near) {
      add(at_one, out);
      at_one.clear();
    }
    at_one.push_back(p);
  }
  add(at_one, out);
  return out;
}

}  // namespace

std::vector<ForceCurve> curves_of(std::vector<StaticPoint> points) {
  std::vector<ForceCurve> out;
  if (points.empty()) return out;
  const std::vector<double> lengths = values_of(points, &StaticPoint::length);
  const double longest = std::max(0.0, largest(lengths)),
               top = std::max(0.0, largest(values_of(points, &StaticPoint::pressure)));
  const std::vector<int> group = mount_groups(lengths, 0.002 * longest, widest_mount * longest);

  std::vector<std::tuple<double, int, int, std::size_t>> order;
  for (std::size_t i = 0; i < points.size(); ++i)
    order.emplace_back(points[i].rest_length, static_cast<int>(points[i].branch), group[i], i);
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < order.size();) {
    const auto [rest, branch, g, first] = order[i];
    std::vector<StaticPoint> own;
    for (; i < order.size(); ++i) {
      const auto [r, b, h, at] = order[i];
      if (r != rest || b != branch || h != g) break;
      own.push_back(points[at]);
    }
    out.push_back(curve_of(own, 0.01 * top));
  }
  return out;
}

std::vector<RepeatedReading> repeated_readings(const std::vector<StaticPoint>& points) {
  if (points.empty()) return {};
  const std::vector<double> lengths = values_of(points, &StaticPoint::length);
  const double longest = largest(lengths), top = largest(values_of(points, &StaticPoint::pressure));
  const std::vector<int> group = mount_groups(lengths, one_length * longest, one_length * longest);
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) {
    const StaticPoint& p = points[i];
    return std::tuple(p.rest_length, static_cast<int>(p.branch), group[i], p.pressure);
  });
  const auto is_equal = [&](const StaticPoint& a, const StaticPoint& b) {
    return a.rest_length == b.rest_length && a.branch == b.branch &&
           std::abs(a.length - b.length) <= one_length * longest &&
           std::abs(a.pressure - b.pressure) <= one_pressure * top;
  };
  std::vector<RepeatedReading> out;
  for (std::size_t k = 0; k < order.size();) {
    const StaticPoint& at = points[order[k]];
    std::size_t first = order[k], last = order[k], n = 1;
    for (++k; k < order.size() && is_equal(at, points[order[k]]); ++k, ++n) {
      first = std::min(first, order[k]);
      last = std::max(last, order[k]);
    }
    if (n > 1 && at.branch != Branch::unknown)
      out.push_back({points[first].force, points[last].force});
  }
  return out;
}

std::optional<double> force_at(const ForceCurve& curve, double pressure) {
  const std::vector<double>& p = curve.pressure;
  if (p.size() < 2 || pressure < p.front() || pressure > p.back()) return {};
  std::size_t i = 1;
  while (i + 1 < p.size() && p[i] < pressure) ++i;
  const double share = (pressure - p[i - 1]) / (p[i] - p[i - 1]);
  return curve.force[i - 1] + share * (curve.force[i] - curve.force[i - 1]);
}

std::optional<double> threshold_of(const ForceCurve& curve) {
  const double most = *std::max_element(curve.force.begin(), curve.force.end());
  double n = 0, p = 0, f = 0, pp = 0, pf = 0;
  for (std::size_t i = 0; i < curve.force.size(); ++i) {
    if (!(curve.force[i] > 0.1 * most) || curve.force[i] > 0.7 * most) continue;
    n += 1;
    p += curve.pressure[i];
    f += curve.force[i];
    pp += curve.pressure[i] * curve.pressure[i];
    pf += curve.pressure[i] * curve.force[i];
  }
  const double slope = (n * pf - p * f) / (n * pp - p * p);
  if (n < 3 || !(slope > 0)) return {};
  return (p - f / slope) / n;
}

}  // namespace sinew::identify
