#include "sinew/identify/actuator/static_settled.h"

#include <algorithm>
#include <cmath>

#include "sinew/identify/data/quality.h"

namespace sinew::identify {

namespace {

constexpr double shortest_window = 0.12;  // [s]
constexpr double of_range = 0.005;        // share of the range of pressures
constexpr double of_scatter = 6;
constexpr std::size_t median_reach = 7;  // samples on each side of a running median

// Returns the standard deviation of single samples about the smoothed ones, from the median.
double scatter_about(std::span<const double> values, std::span<const double> smooth) {
  std::vector<double> off;
  for (std::size_t i = 0; i < values.size(); ++i) off.push_back(std::abs(values[i] - smooth[i]));
  return 1.4826 * median(off);
}

// Counts the runs of settled samples that last at least for a window.
int rests_of(const std::vector<bool>& settled, std::span<const double> time, double window) {
  int out = 0;
  for (std::size_t i = 0; i < settled.size();) {
    std::size_t end = i;
    while (end < settled.size() && settled[end] == settled[i]) ++end;
    if (settled[i] && time[end - 1] - time[i] >= window) ++out;
    i = end;
  }
  return out;
}

}  // namespace

std::size_t Settled::moving() const {
  return static_cast<std::size_t>(std::ranges::count(sample, false));
}

Settled settled_samples(std::span<const double> time, std::span<const double> pressure) {
  Settled out{.sample = std::vector<bool>(time.size(), true), .window = shortest_window};
  if (time.size() < 3) return out;
  const std::vector<double> p = running_medians(pressure, median_reach);
  const auto [lowest, highest] = std::ranges::minmax(p);
  out.window = std::max(shortest_window, 3 * median(steps_of(time)));
  out.most = std::max(of_range * (highest - lowest), of_scatter * scatter_about(pressure, p));

  std::size_t from = 0, to = 0;
  for (std::size_t i = 0; i < time.size(); ++i) {
    while (time[from] < time[i] - 0.5 * out.window) ++from;
    while (to + 1 < time.size() && time[to + 1] <= time[i] + 0.5 * out.window) ++to;
    out.sample[i] = std::abs(p[to] - p[from]) <= out.most;
  }
  out.rests = rests_of(out.sample, time, out.window);
  return out;
}

}  // namespace sinew::identify
