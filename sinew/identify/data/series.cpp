#include "sinew/identify/data/series.h"

#include <algorithm>
#include <array>

namespace sinew::identify {

namespace {

// Sums for a least squares parabola through samples; t = 0 is the sample of interest.
struct Sums {
  double s[5] = {}, y[3] = {};

  void add(double t, double value) {
    double power = 1;
    for (int k = 0; k < 5; ++k, power *= t) {
      s[k] += power;
      if (k < 3) y[k] += power * value;
    }
  }

  // Returns first and second derivative at t = 0, by Cramer's rule.
  std::array<double, 2> rates() const {
    const double d = s[0] * (s[2] * s[4] - s[3] * s[3]) - s[1] * (s[1] * s[4] - s[2] * s[3]) +
                     s[2] * (s[1] * s[3] - s[2] * s[2]);
    const double slope = s[0] * (y[1] * s[4] - y[2] * s[3]) - y[0] * (s[1] * s[4] - s[2] * s[3]) +
                         s[2] * (s[1] * y[2] - s[2] * y[1]);
    const double bend = s[0] * (s[2] * y[2] - s[3] * y[1]) - s[1] * (s[1] * y[2] - s[2] * y[1]) +
                        y[0] * (s[1] * s[3] - s[2] * s[2]);
    return {slope / d, 2 * bend / d};
  }
};

}  // namespace

StraightLine line_through(std::span<const double> x, std::span<const double> y) {
  const auto n = static_cast<double>(x.size());
  StraightLine out;
  for (std::size_t i = 0; i < x.size(); ++i) {
    out.x += x[i] / n;
    out.y += y[i] / n;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    out.xx += (x[i] - out.x) * (x[i] - out.x);
    out.xy += (x[i] - out.x) * (y[i] - out.y);
  }
  return out;
}

Rates rates_of(std::span<const double> time, std::span<const double> values, double window) {
  const std::size_t n = time.size();
  Rates out{std::vector<double>(n), std::vector<double>(n)};
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t from = i, to = i;
    while (from > 0 && (time[i] - time[from - 1] <= 0.5 * window || i - from < 2)) --from;
    while (to + 1 < n && (time[to + 1] - time[i] <= 0.5 * window || to - i < 2)) ++to;
    const double size = std::max(time[to] - time[i], time[i] - time[from]);
    Sums sums;
    for (std::size_t k = from; k <= to; ++k)
      sums.add((time[k] - time[i]) / size, values[k] - values[i]);
    const auto [slope, bend] = sums.rates();
    out.first[i] = slope / size;
    out.second[i] = bend / (size * size);
  }
  return out;
}

void delayed(std::span<const double> time, std::span<const double> values, double delay,
             std::span<double> out) {
  const std::size_t n = time.size();
  std::vector<double> slope(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t a = i == 0 ? 0 : i - 1, b = std::min(i + 1, n - 1);
    slope[i] = (values[b] - values[a]) / (time[b] - time[a]);
  }
  std::size_t k = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = std::clamp(time[i] - delay, time[0], time[n - 1]);
    while (k > 0 && time[k] > t) --k;
    while (k + 2 < n && time[k + 1] <= t) ++k;
    const double h = time[k + 1] - time[k], s = (t - time[k]) / h;
    const double a = values[k], b = values[k + 1], da = h * slope[k], db = h * slope[k + 1];
    out[i] = a + s * (da + s * (3 * (b - a) - 2 * da - db + s * (2 * (a - b) + da + db)));
  }
}

}  // namespace sinew::identify
