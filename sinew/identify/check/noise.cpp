#include "sinew/identify/check/noise.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sinew/identify/actuator/static_settled.h"
#include "sinew/units/constants.h"

namespace sinew::identify {

namespace {

constexpr std::size_t rest_window = 25;  // samples that a line is laid through
constexpr double same_length = 2e-3;     // of the longest: readings of one mount
constexpr double same_pressure = 0.01;   // of the highest: readings of one step

// Squares about something, and how many of them are free.
struct Squares {
  double sum = 0, freedom = 0;
  std::size_t readings = 0;
};

// Adds what values leave of a straight line through them.
void add_about_line(const double* y, std::size_t n, Squares& out) {
  double sy = 0, sxy = 0, sxx = 0;
  const double middle = 0.5 * static_cast<double>(n - 1);
  for (std::size_t i = 0; i < n; ++i) {
    const double x = static_cast<double>(i) - middle;
    sy += y[i];
    sxy += x * y[i];
    sxx += x * x;
  }
  const double mean = sy / static_cast<double>(n), slope = sxy / sxx;
  for (std::size_t i = 0; i < n; ++i)
    out.sum += std::pow(y[i] - mean - slope * (static_cast<double>(i) - middle), 2);
  out.freedom += static_cast<double>(n) - 2;
  out.readings += n;
}

// Samples that rest together, in windows.
void add_rests(const Measured& m, Squares& out) {
  const bool weighs = m.has("load");
  const std::vector<double>& force = m[weighs ? "load" : "force"];
  const std::vector<bool> rests = settled_samples(m["time"], m["pressure"]).sample;
  Squares own;
  for (std::size_t i = 0; i < force.size();) {
    std::size_t end = i;
    while (end < force.size() && rests[end] && end - i < rest_window) ++end;
    if (end - i >= 5) add_about_line(&force[i], end - i, own);
    i = std::max(end, i + 1);
  }
  const double unit = weighs ? units::standard_gravity : 1;
  out.sum += own.sum * unit * unit;
  out.freedom += own.freedom;
  out.readings += own.readings;
}

// Readings of one muscle, length and branch, by pressure, whose pressures are one: each about their
// line, as they are not quite one.
void add_repeated(const std::vector<StaticPoint>& sorted, double near, Squares& out) {
  for (std::size_t i = 0; i < sorted.size();) {
    std::size_t end = i;
    std::vector<double> force;
    for (; end < sorted.size() && sorted[end].pressure - sorted[i].pressure <= near; ++end)
      force.push_back(sorted[end].force);
    if (force.size() >= 3) add_about_line(force.data(), force.size(), out);
    if (force.size() == 2) {
      out.sum += 0.5 * std::pow(force[1] - force[0], 2);
      out.freedom += 1;
      out.readings += 2;
    }
    i = end;
  }
}

Squares of_tables(const std::vector<StaticPoint>& points) {
  double longest = 0, top = 0;
  for (const StaticPoint& p : points) {
    longest = std::max(longest, p.length);
    top = std::max(top, p.pressure);
  }
  std::vector<StaticPoint> sorted = points;
  sort_points(sorted);
  Squares out;
  for (std::size_t i = 0; i < sorted.size();) {
    std::size_t end = i;
    while (end < sorted.size() && sorted[end].rest_length == sorted[i].rest_length &&
           sorted[end].branch == sorted[i].branch &&
           sorted[end].length - sorted[i].length < same_length * longest)
      ++end;
    std::vector<StaticPoint> own(sorted.begin() + static_cast<std::ptrdiff_t>(i),
                                 sorted.begin() + static_cast<std::ptrdiff_t>(end));
    std::ranges::stable_sort(own, {}, &StaticPoint::pressure);
    add_repeated(own, same_pressure * top, out);
    i = end;
  }
  return out;
}

}  // namespace

ForceNoise force_noise(const CheckInput& input) {
  Squares recorded;
  double strongest = 0;
  for (const StaticPoint& p : input.data.points) strongest = std::max(strongest, p.force);
  for (const CheckedTable& t : input.tables) {
    const Measured& m = t.table;
    if (m.has("time") && m.has("pressure") && m.has("force") != m.has("load"))
      add_rests(m, recorded);
  }
  const bool records = recorded.freedom > 0;
  const Squares squares = records ? recorded : of_tables(input.data.points);
  ForceNoise out;
  if (!(squares.freedom >= 3) || !(strongest > 0)) return out;
  out.deviation = std::sqrt(squares.sum / squares.freedom);
  out.share = out.deviation / strongest;
  out.readings = squares.readings;
  out.from = records ? "settled samples" : "repeated readings";
  return out;
}

}  // namespace sinew::identify
