#include "sinew/report/figures/measure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sinew/analysis/measures/statistics.h"

namespace sinew::report {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

bool there(const Trace& t, std::size_t i) { return !std::isnan(t.x[i]) && !std::isnan(t.y[i]); }

// Returns x at which the line from sample a to sample b has y = level.
double crossing(const Trace& t, std::size_t a, std::size_t b, double level) {
  const double rise = t.y[b] - t.y[a];
  return rise == 0 ? t.x[b] : t.x[a] + (t.x[b] - t.x[a]) * (level - t.y[a]) / rise;
}

// Returns the first x from `from` on with y >= level if `up`, else y <= level.
double first_crossing(const Trace& t, double level, double from, bool up) {
  std::size_t before = t.x.size();  // none yet
  for (std::size_t i = 0; i < t.x.size(); ++i) {
    if (!there(t, i) || t.x[i] < from) continue;
    if (up ? t.y[i] >= level : t.y[i] <= level)
      return before == t.x.size() ? t.x[i] : crossing(t, before, i, level);
    before = i;
  }
  return nothing;
}

struct ValueRange {
  double least = nothing, greatest = nothing;
};

ValueRange range_of(const Trace& t) {
  ValueRange r;
  for (std::size_t i = 0; i < t.y.size(); ++i) {
    if (!there(t, i)) continue;
    if (!(t.y[i] >= r.least)) r.least = t.y[i];
    if (!(t.y[i] <= r.greatest)) r.greatest = t.y[i];
  }
  return r;
}

}  // namespace

double value_at(const Trace& t, double x) {
  std::size_t before = t.x.size();
  for (std::size_t i = 0; i < t.x.size(); ++i) {
    if (!there(t, i)) continue;
    if (t.x[i] == x) return t.y[i];
    if (t.x[i] > x) {
      if (before == t.x.size()) return nothing;
      const double share = (x - t.x[before]) / (t.x[i] - t.x[before]);
      return t.y[before] + share * (t.y[i] - t.y[before]);
    }
    before = i;
  }
  return nothing;
}

double first_at_least(const Trace& t, double level, double from) {
  return first_crossing(t, level, from, true);
}
double first_at_most(const Trace& t, double level, double from) {
  return first_crossing(t, level, from, false);
}

StraightLine line_of(const Trace& t) {
  double n = 0, x = 0, y = 0;
  for (std::size_t i = 0; i < t.x.size(); ++i)
    if (there(t, i)) n += 1, x += t.x[i], y += t.y[i];
  x /= n, y /= n;
  double xx = 0, xy = 0;
  for (std::size_t i = 0; i < t.x.size(); ++i) {
    if (!there(t, i)) continue;
    xx += (t.x[i] - x) * (t.x[i] - x);
    xy += (t.x[i] - x) * (t.y[i] - y);
  }
  return {xy / xx, y - xy / xx * x};
}

double bend(const Trace& t) {
  const StraightLine line = line_of(t);
  const ValueRange range = range_of(t);
  double largest = 0;
  for (std::size_t i = 0; i < t.x.size(); ++i)
    if (there(t, i))
      largest = std::max(largest, std::fabs(t.y[i] - line.offset - line.slope * t.x[i]));
  return largest / (range.greatest - range.least);
}

double largest_fall(const Trace& t) {
  double highest = nothing, fall = nothing;
  for (std::size_t i = 0; i < t.y.size(); ++i) {
    if (!there(t, i)) continue;
    if (!(t.y[i] <= highest)) highest = t.y[i];
    if (!(highest - t.y[i] <= fall)) fall = highest - t.y[i];
  }
  return fall;
}

double least(const Trace& t) { return range_of(t).least; }
double greatest(const Trace& t) { return range_of(t).greatest; }

Trace part(const Trace& t, double from, double to) {
  const auto begin = std::ranges::lower_bound(t.x, from);
  const auto end = std::ranges::upper_bound(t.x, to);
  const auto at = static_cast<std::size_t>(begin - t.x.begin());
  const auto length = static_cast<std::size_t>(std::max<std::ptrdiff_t>(end - begin, 0));
  return {t.x.subspan(at, length), t.y.subspan(at, length)};
}

double mean(const Trace& t) {
  double n = 0, sum = 0;
  for (std::size_t i = 0; i < t.y.size(); ++i)
    if (there(t, i)) n += 1, sum += t.y[i];
  return sum / n;
}

double first_dip(const Trace& t, double from) {
  for (std::size_t i = 1; i + 1 < t.y.size(); ++i) {
    if (t.x[i] < from || !(t.y[i] < t.y[i - 1])) continue;
    std::size_t next = i + 1;  // end of a flat minimum
    while (next + 1 < t.y.size() && t.y[next] == t.y[i]) ++next;
    if (t.y[next] > t.y[i]) return t.x[i];
  }
  return nothing;
}

double amplitude(const Trace& t, double width) {
  if (t.x.size() < 3) return nothing;
  const signals::Column y(t.y.begin(), t.y.end());
  const std::vector<double> seconds(t.x.size(), 1.0);
  const std::size_t half = analysis::half_window(width, t.x[1] - t.x[0]);
  return std::sqrt(2.0) * analysis::rms(analysis::high_passed(y, half), seconds);
}

}  // namespace sinew::report
