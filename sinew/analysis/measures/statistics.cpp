#include "sinew/analysis/measures/statistics.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

namespace sinew::analysis {

std::vector<TurningPoint> turning_points(std::span<const double> values, double back) {
  std::vector<TurningPoint> out;
  TurningPoint top, bottom;  // the extremes since the last turning point
  int direction = 0;         // 1 while rising, -1 while falling, 0 before the first change
  bool first = true;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const TurningPoint now{i, values[i]};
    if (!std::isfinite(now.value)) continue;
    if (first || now.value > top.value) top = now;
    if (first || now.value < bottom.value) bottom = now;
    first = false;

    // A turning point is found once the values have come back from it; the search for the opposite
    // extreme begins here.
    if (direction >= 0 && top.value - now.value >= back) {
      if (direction > 0) out.push_back(top);
      direction = -1;
      bottom = now;
    } else if (direction <= 0 && now.value - bottom.value >= back) {
      if (direction < 0) out.push_back(bottom);
      direction = 1;
      top = now;
    }
  }
  return out;
}

std::vector<double> amplitudes(const std::vector<TurningPoint>& points) {
  std::vector<double> out;
  for (std::size_t i = 1; i < points.size(); ++i)
    out.push_back(0.5 * std::abs(points[i].value - points[i - 1].value));
  return out;
}

namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

template <class Of>
double mean_of(Values values, Seconds seconds, Of of) {
  double sum = 0, time = 0;
  const std::size_t n = std::min(values.size(), seconds.size());
  for (std::size_t i = 0; i < n; ++i) {
    if (!(seconds[i] > 0) || !std::isfinite(values[i])) continue;
    sum += of(values[i]) * seconds[i];
    time += seconds[i];
  }
  return time > 0 ? sum / time : no_value;
}

template <class Of>
double largest_of(Values values, Seconds seconds, Of of) {
  double best = no_value;
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

// Sums the differences from the first finite value, which reduces rounding errors.
signals::Column moving_mean(Values values, std::size_t half) {
  const std::size_t n = values.size();
  const auto first =
      std::find_if(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
  const double offset = first == values.end() ? no_value : *first;

  // Sum and count of all values up to a row.
  struct Sum {
    double sum = 0, count = 0;
  };
  const auto add = [&](Sum& s, std::size_t i) {
    const bool given = std::isfinite(values[i]);
    s.sum += given ? values[i] - offset : 0.0;
    s.count += given ? 1.0 : 0.0;
  };
  signals::Column out(values.file());
  std::deque<Sum> sums{{}};  // sums within the window
  for (std::size_t i = 0; i < std::min(half, n); ++i) {
    sums.push_back(sums.back());
    add(sums.back(), i);
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (i + half < n) {
      sums.push_back(sums.back());
      add(sums.back(), i + half);
    }
    double mean = no_value;
    if (i >= half && i + half < n) {
      if (i > half) sums.pop_front();
      const double samples = sums.back().count - sums.front().count;
      if (samples > 0) mean = offset + (sums.back().sum - sums.front().sum) / samples;
    }
    out.push_back(mean);
  }
  return out;
}

signals::Column high_passed(Values values, std::size_t half) {
  const signals::Column mean = moving_mean(values, half);
  signals::Column out(values.file());
  for (std::size_t i = 0; i < mean.size(); ++i) out.push_back(values[i] - mean[i]);
  return out;
}

std::size_t half_window(double width, double period) {
  const double half = 0.5 * (width / period - 1.0);
  return half > 0 ? static_cast<std::size_t>(std::llround(half)) : 0;
}

}  // namespace sinew::analysis
