#include "sinew/analysis/align/clock_fit.h"

#include <algorithm>
#include <cmath>

namespace sinew::analysis {
namespace {

constexpr double least_alike = 0.6;
constexpr double quiet = 0.02;  // of a channel's variance: a piece with less of it says nothing
constexpr double fastest_drift = 0.02;  // from piece to piece

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

double scale_of(std::vector<double> residuals) {
  for (double& r : residuals) r = std::abs(r);
  return 1.4826 * median(std::move(residuals));
}

// The first one's time in which both are there.
Interval overlap(std::span<const Pair> pairs, const Clock& clock) {
  Interval out{-INFINITY, INFINITY};
  for (const Pair& p : pairs) {
    out.from = std::max({out.from, p.first.time.front(), clock.first(p.other.time.front())});
    out.to = std::min({out.to, p.first.time.back(), clock.first(p.other.time.back())});
  }
  return out;
}

bool moves_in(const Pair& pair, double variance, const Interval& piece) {
  const std::vector<double>& time = pair.first.time;
  double n = 0, sum = 0, square = 0, origin = 0;
  for (auto i = std::ranges::lower_bound(time, piece.from) - time.begin();
       i < std::ssize(time) && time[static_cast<std::size_t>(i)] <= piece.to; ++i) {
    const double v = pair.first.value[static_cast<std::size_t>(i)];
    if (n == 0) origin = v;
    n += 1, sum += v - origin, square += (v - origin) * (v - origin);
  }
  return n > 0 && square / n - sum / n * sum / n > quiet * variance;
}

// The best shift within `reach` of the clock's; nothing where it lies at the end of that.
std::optional<LocalShift> shift_in(std::span<const Pair> pairs, const Clock& about,
                                   const Interval& piece, double reach, double width) {
  const int side = std::max(1, static_cast<int>(std::ceil(reach / width)));
  int best = 0;
  double best_r = -INFINITY;
  for (int i = -side; i <= side; ++i) {
    const auto found = likeness(pairs, {about.shift + i * width, about.rate}, piece);
    if (found && found->r > best_r) best = i, best_r = found->r;
  }
  if (best_r < least_alike || std::abs(best) == side) return std::nullopt;
  const Peak peak = refine(pairs, {about.shift + best * width, about.rate}, width, piece);
  if (!std::isfinite(peak.uncertainty)) return std::nullopt;
  const double middle = 0.5 * (piece.from + piece.to);
  return LocalShift{middle, peak.clock.other(middle) - middle,
                    std::max(peak.uncertainty, 0.01 * longest_step(pairs))};
}

}  // namespace

std::vector<LocalShift> local_shifts(std::span<const Pair> pairs, const Clock& about,
                                     double known_at, double half_width) {
  const Interval all = overlap(pairs, about);
  const double duration = all.to - all.from, step = longest_step(pairs);
  if (!(duration > 0)) return {};
  const double count =
      std::clamp(std::floor(duration / std::max(2 * half_width, 16 * step)), 4.0, 24.0);
  const double length = duration / count, width = std::max(step, half_width / 8);

  std::vector<double> variance;
  for (const Pair& p : pairs) variance.push_back(spread_of(p.first).variance);

  // From where the clock is known to both ends: what is found in a piece is where the next one
  // begins to look.
  std::vector<LocalShift> out;
  const int pieces = static_cast<int>(count);
  const int start = std::clamp(static_cast<int>((known_at - all.from) / length), 0, pieces - 1);
  for (const int by : {1, -1}) {
    Clock clock = about;
    for (int k = by > 0 ? start : start - 1; k >= 0 && k < pieces; k += by) {
      const Interval piece{all.from + k * length, all.from + (k + 1) * length};
      std::vector<Pair> moving;
      for (std::size_t i = 0; i < pairs.size(); ++i)
        if (moves_in(pairs[i], variance[i], piece)) moving.push_back(pairs[i]);
      if (moving.empty()) continue;
      const double reach = std::min(half_width, fastest_drift * length + 0.5 * half_width);
      const auto found = shift_in(moving, clock, piece, reach, width);
      if (!found) continue;
      clock.shift = found->shift - about.rate * found->time;
      out.push_back(*found);
    }
  }
  std::ranges::sort(out, {}, &LocalShift::time);
  return out;
}

namespace {

// Sums of a weighted straight line through points about its first one.
struct Line {
  double w = 0, x = 0, xx = 0, y = 0, xy = 0;
  void add(double weight, double t, double d) {
    w += weight, x += weight * t, xx += weight * t * t, y += weight * d, xy += weight * t * d;
  }
  double det() const { return w * xx - x * x; }
};

// With the rate, or without: then `known` is it.
ClockFit fit(std::span<const LocalShift> shifts, bool rate, double known) {
  std::vector<double> huber(shifts.size(), 1), error(shifts.size());
  ClockFit out{.clock = {0, known}, .pieces = shifts.size()};
  Line sums;
  for (int again = 0; again < 12; ++again) {
    sums = {};
    for (std::size_t i = 0; i < shifts.size(); ++i) {
      const LocalShift& s = shifts[i];
      sums.add(huber[i] / (s.uncertainty * s.uncertainty), s.time, s.shift - known * s.time);
    }
    out.clock = {sums.y / sums.w, known};
    if (rate)
      out.clock = {(sums.xx * sums.y - sums.x * sums.xy) / sums.det(),
                   known + (sums.w * sums.xy - sums.x * sums.y) / sums.det()};
    for (std::size_t i = 0; i < shifts.size(); ++i)
      error[i] = (shifts[i].shift - out.clock.shift - out.clock.rate * shifts[i].time) /
                 shifts[i].uncertainty;
    const double scale = std::max(scale_of(error), 1e-9);
    for (std::size_t i = 0; i < shifts.size(); ++i)
      huber[i] = std::min(1.0, 1.345 * scale / std::max(std::abs(error[i]), 1e-300));
  }
  double square = 0;
  for (std::size_t i = 0; i < shifts.size(); ++i) square += huber[i] * error[i] * error[i];
  const double q = std::max(1.0, square / (static_cast<double>(shifts.size()) - (rate ? 2 : 1)));
  out.shift_uncertainty = std::sqrt(q * (rate ? sums.xx / sums.det() : 1 / sums.w));
  out.rate_uncertainty = rate ? std::sqrt(q * sums.w / sums.det()) : 0;
  return out;
}

}  // namespace

ClockFit fit_clock(std::span<const LocalShift> shifts) { return fit(shifts, true, 0); }

ClockFit fit_shift(std::span<const LocalShift> shifts, double rate) {
  return fit(shifts, false, rate);
}

}  // namespace sinew::analysis
