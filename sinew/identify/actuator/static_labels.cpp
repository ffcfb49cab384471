#include "sinew/identify/actuator/static_labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sinew::identify {

namespace {

constexpr double nearest_mount = 0.02;  // share of the rest length
constexpr double most_deviations = 10;
constexpr double most_of_gap = 0.9;  // share of the gap to the next mount: keeps their order

bool same(double a, double b) { return std::abs(a - b) < same_label; }

// Sets the bounds of one muscle's error; none if its label cannot be fitted.
void set_bounds(std::span<const StaticPoint> points, RestLengthError& label) {
  const double rest = label.labelled, most = most_deviations * rest_length_deviation(rest);
  double below = most / most_of_gap, above = below;
  bool has_rest = false, has_other = false;
  for (const StaticPoint& p : points) {
    if (!same(p.rest_length, rest)) continue;
    if (at_rest(p.length, rest)) {
      has_rest = true;
      continue;
    }
    has_other = true;
    double& gap = p.length < rest ? below : above;
    gap = std::min(gap, std::abs(p.length - rest));
  }
  if (!has_rest || !has_other || std::min(below, above) < nearest_mount * rest) return;
  label.low = -most_of_gap * below;
  label.high = most_of_gap * above;
}

}  // namespace

double rest_length_deviation(double labelled) { return std::hypot(0.5e-3, 0.005 * labelled); }

bool at_rest(double length, double rest_length) {
  return std::abs(length - rest_length) < 0.002 * rest_length;
}

void unite_labels(std::vector<StaticPoint>& points) {
  std::vector<double> labels;
  for (StaticPoint& p : points) {
    const auto at =
        std::ranges::find_if(labels, [&](double label) { return same(label, p.rest_length); });
    if (at == labels.end())
      labels.push_back(p.rest_length);
    else
      p.rest_length = *at;
  }
}

std::vector<RestLengthError> labels_of(std::span<const StaticPoint> points) {
  std::vector<RestLengthError> out;
  for (const StaticPoint& p : points)
    if (std::ranges::find(out, p.rest_length, &RestLengthError::labelled) == out.end())
      out.push_back({.labelled = p.rest_length});
  for (RestLengthError& label : out) set_bounds(points, label);
  if (std::ranges::count_if(out, &RestLengthError::is_fitted) < 2)
    for (RestLengthError& label : out) label.low = label.high = 0;
  return out;
}

Parameter parameter_of(const RestLengthError& label) {
  return {.name = fmt::format("{}{:.6g}mm", rest_length_error, 1e3 * label.labelled),
          .unit = "m",
          .low = label.low,
          .high = label.high,
          .scale = 0.02 * label.labelled};
}

void widen_by_common(std::span<const RestLengthError> labels, const RestLengthError& label,
                     int freedom, Estimate& estimate) {
  if (estimate.at_bound) return;
  double square = 0, n = 0;
  for (const RestLengthError& r : labels) {
    if (!r.is_fitted()) continue;
    square += std::pow(rest_length_deviation(r.labelled) / r.labelled, 2);
    n += 1;
  }
  const double common = label.labelled * std::sqrt(square) / n;
  estimate.set_interval(std::hypot(estimate.standard_error, common),
                        t_quantile(std::max(1, freedom)));
}

double fitted_length(const StaticSetting& setting, const StaticPoint& point) {
  if (!at_rest(point.length, point.rest_length)) return point.length;
  return point.length + (rest_length_of(setting, point.rest_length) - point.rest_length);
}

}  // namespace sinew::identify
