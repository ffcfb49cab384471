#include "sinew/analysis/measures/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew::analysis {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

template <class Of>
double mean_of(Values values, Seconds seconds, Of of) {
  double sum = 0, time = 0;
  const std::size_t n = std::min(values.size(), seconds.size());
  for (std::size_t i = 0; i < n; ++i) {
    if (!(seconds[i] > 0) || !std::isfinite(values[i])) continue;
    sum += of(values[i]) * seconds[i];
    time += seconds[i];
  }
  return time > 0 ? sum / time : none;
}

template <class Of>
double largest_of(Values values, Seconds seconds, Of of) {
  double best = none;
  const std::size_t n = std::min(values.size(), seconds.size());
  for (std::size_t i = 0; i < n; ++i) {
    if (!(seconds[i] > 0) || !std::isfinite(values[i])) continue;
    const double x = of(values[i]);
    if (!(x <= best)) best = x;
  }
  return best;
}

}  // namespace

double mean(Values values, Seconds seconds) {
  return mean_of(values, seconds, [](double x) { return x; });
}

double rms(Values values, Seconds seconds) {
  return std::sqrt(mean_of(values, seconds, [](double x) { return x * x; }));
}

double deviation(Values values, Seconds seconds) {
  const double m = mean(values, seconds);
  return std::sqrt(mean_of(values, seconds, [m](double x) { return (x - m) * (x - m); }));
}

double smallest(Values values, Seconds seconds) {
  return -largest_of(values, seconds, [](double x) { return -x; });
}

double largest(Values values, Seconds seconds) {
  return largest_of(values, seconds, [](double x) { return x; });
}

double largest_magnitude(Values values, Seconds seconds) {
  return largest_of(values, seconds, [](double x) { return std::abs(x); });
}

// Running sums of what differs from the first reading, which keeps them small.
std::vector<double> moving_mean(Values values, std::size_t half) {
  const std::size_t n = values.size();
  std::vector<double> out(n, none);
  const auto first =
      std::find_if(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
  if (first == values.end()) return out;

  std::vector<double> sum(n + 1, 0.0), count(n + 1, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const bool given = std::isfinite(values[i]);
    sum[i + 1] = sum[i] + (given ? values[i] - *first : 0.0);
    count[i + 1] = count[i] + (given ? 1.0 : 0.0);
  }
  for (std::size_t i = half; i + half < n; ++i) {
    const double samples = count[i + half + 1] - count[i - half];
    if (samples > 0) out[i] = *first + (sum[i + half + 1] - sum[i - half]) / samples;
  }
  return out;
}

std::vector<double> high_passed(Values values, std::size_t half) {
  std::vector<double> out = moving_mean(values, half);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = values[i] - out[i];
  return out;
}

std::size_t half_window(double width, double period) {
  const double half = 0.5 * (width / period - 1.0);
  return half > 0 ? static_cast<std::size_t>(std::llround(half)) : 0;
}

}  // namespace sinew::analysis
