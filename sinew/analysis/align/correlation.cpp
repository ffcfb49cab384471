#include "sinew/analysis/align/correlation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "sinew/config/diagnostics.h"
#include "sinew/units/letters.h"

namespace sinew::analysis {

namespace {

constexpr std::size_t at_rest = 5, stays = 3;  // samples

// Returns the instant between samples i-1 and i at which the signal passes the level.
Instant between(const Signal& s, std::size_t i, double level, double noise) {
  const double t0 = s.time[i - 1], t1 = s.time[i], rise = s.value[i] - s.value[i - 1];
  const double t = t0 + (t1 - t0) * (level - s.value[i - 1]) / rise;
  // The slope is taken over a few samples to reduce the effect of noise.
  const std::size_t from = i > 2 ? i - 3 : 0, to = std::min(i + 2, s.time.size() - 1);
  const double slope = std::abs(s.value[to] - s.value[from]) / (s.time[to] - s.time[from]);
  const double by_noise = slope > 0 ? noise / slope : t1 - t0;
  return {t, std::max(by_noise, (t1 - t0) / std::sqrt(12.0))};
}

}  // namespace

std::optional<Instant> first_crossing(const Signal& s, double level, bool upwards) {
  const double sign = upwards ? 1 : -1;
  for (std::size_t i = 1; i < s.value.size(); ++i)
    if (sign * (s.value[i - 1] - level) <= 0 && sign * (s.value[i] - level) > 0)
      return between(s, i, level, spread_of(s).noise);
  return std::nullopt;
}

std::optional<Instant> first_motion(const Signal& s, double band) {
  if (s.value.size() < at_rest + stays) return std::nullopt;
  std::array<double, at_rest> begins{};
  std::copy_n(s.value.begin(), at_rest, begins.begin());
  std::ranges::sort(begins);
  const double from = begins[at_rest / 2];
  const auto beyond = [&](std::size_t i) { return std::abs(s.value[i] - from) > band; };

  for (std::size_t i = 1; i + stays <= s.value.size(); ++i) {
    if (!beyond(i) || !beyond(i + 1) || !beyond(i + 2)) continue;
    if (i < at_rest || beyond(i - 1)) return std::nullopt;
    return between(s, i, s.value[i] > from ? from + band : from - band, spread_of(s).noise);
  }
  return std::nullopt;
}

Event parse_event(const std::string& text) {
  const std::size_t sign = text.find_first_of("<>");
  const auto fail = [&](std::string_view found) {
    config::fail({"event", 0, 0}, "", std::string(found),
                 "a channel, > or <, and a level with its unit", "\"/joint/elbow/angle > 10 deg\"");
  };
  if (sign == text.npos) fail("\"" + text + "\", without > or <");
  Event out{std::string(units::trimmed(text.substr(0, sign))), text[sign] == '>',
            std::string(units::trimmed(text.substr(sign + 1)))};
  if (!out.channel.starts_with("/")) fail("\"" + text + "\", which begins with no channel");
  if (out.level.empty()) fail("\"" + text + "\", without a level");
  return out;
}

double EventPair::uncertainty() const { return std::hypot(first.uncertainty, other.uncertainty); }

std::optional<EventPair> surest_motion(std::span<const Pair> pairs) {
  std::optional<EventPair> best;
  for (const Pair& pair : pairs) {
    const Spread a = spread_of(pair.first), b = spread_of(pair.other);
    if (!a.moves() || !b.moves()) continue;
    const double band = std::max(0.05 * std::max(a.range, b.range), 8 * std::max(a.noise, b.noise));
    const auto first = first_motion(pair.first, band), other = first_motion(pair.other, band);
    if (!first || !other) continue;
    EventPair found{*first, *other,
                    fmt::format("{} moves by {:.3g}{}{}", pair.first.channel, band,
                                pair.unit == "1" ? "" : " ", pair.unit == "1" ? "" : pair.unit)};
    if (!best || found.uncertainty() < best->uncertainty()) best = std::move(found);
  }
  return best;
}

namespace {

constexpr double most_steps = 4096;
constexpr double rate_step = 0.0025, most_rate = 0.02;
constexpr double nearly_as_high = 0.05;

// Sums of products of pairs, less the first pair, which avoids cancellation.
struct Moments {
  double a0 = 0, b0 = 0, n = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;

  void add(double x, double y) {
    if (n == 0) a0 = x, b0 = y;
    x -= a0, y -= b0;
    n += 1, a += x, b += y, aa += x * x, bb += y * y, ab += x * y;
  }
  double correlation() const {
    const double below = (n * aa - a * a) * (n * bb - b * b);
    return below > 0 ? (n * ab - a * b) / std::sqrt(below) : NAN;
  }
};

// Returns the correlation of one channel; NaN if too few samples meet or one of both is constant.
double correlation_of(const Pair& pair, const Clock& clock, std::optional<Interval> within,
                      std::size_t& samples) {
  const std::vector<double>& time = pair.first.time;
  Reader other(pair.other);
  Moments sums;
  std::size_t i = 0, end = time.size();
  if (within) {
    i = static_cast<std::size_t>(std::ranges::lower_bound(time, within->from) - time.begin());
    end = static_cast<std::size_t>(std::ranges::upper_bound(time, within->to) - time.begin());
  }
  const std::size_t wanted = end > i ? end - i : 0;
  for (; i < end; ++i) {
    const double t = clock.other(time[i]);
    if (other.holds(t)) sums.add(pair.first.value[i], other.at(t));
  }
  samples = static_cast<std::size_t>(sums.n);
  const double shorter = std::min(pair.first.duration(), pair.other.duration());
  const double least = within ? 0.75 * static_cast<double>(wanted)
                              : 0.5 * shorter / std::max(pair.first.step(), 1e-12);
  return sums.n < 8 || sums.n < least ? NAN : sums.correlation();
}

// --- search on a grid ---

struct Grid {
  double from = 0, step = 0;
  std::vector<double> value;
};

// Returns the means of a signal's samples over each step, or a point of the line between samples if
// a step contains none; times are divided by `slower`.
Grid grid_of(const Signal& s, double step, double slower) {
  Grid out{s.time.front() / slower, step, {}};
  Reader reader(s);
  const auto steps = static_cast<std::size_t>(s.duration() / slower / step) + 1;
  std::size_t k = 0;
  for (std::size_t i = 0; i < steps; ++i) {
    const double middle = out.from + static_cast<double>(i) * step;
    double sum = 0, count = 0;
    for (; k < s.time.size() && s.time[k] / slower < middle + 0.5 * step; ++k)
      sum += s.value[k], count += 1;
    const double t = std::clamp(middle * slower, s.time.front(), s.time.back());
    out.value.push_back(count > 0 ? sum / count : reader.at(t));
  }
  return out;
}

// Subtracts the mean, which reduces rounding errors and does not change r.
void center(std::vector<double>& values) {
  double mean = 0;
  for (const double v : values) mean += v / static_cast<double>(values.size());
  for (double& v : values) v -= mean;
}

// Prefix sums of values and of their squares.
struct Running {
  explicit Running(const std::vector<double>& values) : sum{0}, square{0} {
    for (const double v : values) {
      sum.push_back(sum.back() + v);
      square.push_back(square.back() + v * v);
    }
  }
  std::vector<double> sum, square;
};

// Returns sum a_i b_{i+k} for k from -(na - 1) to nb - 1.
std::vector<double> products(const std::vector<double>& a, const std::vector<double>& b) {
  std::size_t n = 1;
  while (n < a.size() + b.size()) n *= 2;
  std::vector<std::complex<double>> fa(n), fb(n);
  std::ranges::copy(a, fa.begin());
  std::ranges::copy(b, fb.begin());
  transform(fa, false);
  transform(fb, false);
  for (std::size_t i = 0; i < n; ++i) fa[i] = std::conj(fa[i]) * fb[i];
  transform(fa, true);
  std::vector<double> out;
  for (std::size_t k = n - a.size() + 1; k < n; ++k) out.push_back(fa[k].real());
  for (std::size_t k = 0; k < b.size(); ++k) out.push_back(fa[k].real());
  return out;
}

// Returns r for whole steps of shift: of lag k at [k + na - 1]; NaN if they overlap too little.
std::vector<double> correlations(Grid a, Grid b) {
  center(a.value), center(b.value);
  const Running of_a(a.value), of_b(b.value);
  std::vector<double> r = products(a.value, b.value);
  const auto na = static_cast<std::ptrdiff_t>(a.value.size());
  const auto nb = static_cast<std::ptrdiff_t>(b.value.size());
  const double least = 0.5 * static_cast<double>(std::min(na, nb));
  for (std::ptrdiff_t k = 1 - na; k < nb; ++k) {
    const auto first = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, -k));
    const auto last = static_cast<std::size_t>(std::min(na, nb - k));
    const std::size_t first_b = first + static_cast<std::size_t>(k),
                      last_b = last + static_cast<std::size_t>(k);
    const auto n = static_cast<double>(last - first);
    const double sa = of_a.sum[last] - of_a.sum[first], sb = of_b.sum[last_b] - of_b.sum[first_b];
    const double va = n * (of_a.square[last] - of_a.square[first]) - sa * sa;
    const double vb = n * (of_b.square[last_b] - of_b.square[first_b]) - sb * sb;
    const double tiny_a = 1e-9 * n * of_a.square.back(), tiny_b = 1e-9 * n * of_b.square.back();
    double& value = r[static_cast<std::size_t>(k + na - 1)];
    value = n < least || !(va > tiny_a) || !(vb > tiny_b)
                ? NAN
                : (n * value - sa * sb) / std::sqrt(va * vb);
  }
  return r;
}

// Mean r of all channels on a grid of shifts: r[i] belongs to `from` + i·`step`.
struct Shifts {
  double from = 0, step = 0;
  std::vector<double> r;
};

// Computes r for all shifts at which both overlap; the middle one aligns their beginnings.
Shifts shifts_of(std::span<const Pair> pairs, double step, double longest, double rate) {
  const auto steps_between = [&](double first, double other) {
    return static_cast<std::ptrdiff_t>(std::llround((other - first) / step));
  };
  const std::ptrdiff_t middle = steps_between(pairs.front().first.time.front(),
                                              pairs.front().other.time.front() / (1 + rate));
  const auto side = static_cast<std::ptrdiff_t>(longest / step);
  Shifts out{static_cast<double>(middle - side) * step, step, {}};
  std::vector<double> count(static_cast<std::size_t>(2 * side + 1), 0);
  out.r.assign(count.size(), 0);
  for (const Pair& pair : pairs) {
    const Grid a = grid_of(pair.first, step, 1), b = grid_of(pair.other, step, 1 + rate);
    const auto na = static_cast<std::ptrdiff_t>(a.value.size());
    const std::vector<double> r = correlations(a, b);
    const std::ptrdiff_t begin = steps_between(a.from, b.from);
    for (std::size_t i = 0; i < out.r.size(); ++i) {
      const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(i) - side + middle - begin + na - 1;
      if (at < 0 || at >= std::ssize(r)) continue;
      const double value = r[static_cast<std::size_t>(at)];
      if (std::isfinite(value)) out.r[i] += value, count[i] += 1;
    }
  }
  const auto all = static_cast<double>(pairs.size());
  for (std::size_t i = 0; i < count.size(); ++i)
    out.r[i] = 2 * count[i] > all ? out.r[i] / count[i] : NAN;
  return out;
}

// Returns the distance from the peak at `top` to half its height, on the nearer side [s].
double half_width(const Shifts& s, std::size_t top) {
  const auto falls = [&](std::ptrdiff_t by) {
    auto i = static_cast<std::ptrdiff_t>(top);
    while (i >= 0 && i < std::ssize(s.r) && s.r[static_cast<std::size_t>(i)] > 0.5 * s.r[top])
      i += by;
    return std::abs(i - static_cast<std::ptrdiff_t>(top));
  };
  return s.step * static_cast<double>(std::max<std::ptrdiff_t>(1, std::min(falls(-1), falls(1))));
}

// Finds the fall of r near the peak, and other peaks.
void add_other_peaks(const Shifts& s, std::size_t top, double near, Found& found) {
  double least = found.r;
  const double rate = found.clock.rate, shift_of_top = s.from + static_cast<double>(top) * s.step;
  for (std::size_t i = 0; i < s.r.size(); ++i) {
    if (!std::isfinite(s.r[i])) continue;
    const double shift = s.from + static_cast<double>(i) * s.step;
    const double apart = std::abs(shift - shift_of_top);
    if (apart <= near) least = std::min(least, s.r[i]);
    const bool inner = i > 0 && i + 1 < s.r.size();
    const bool peak = inner && !(s.r[i - 1] > s.r[i]) && !(s.r[i + 1] > s.r[i]);
    if (peak && apart > 2 * found.half_width && s.r[i] > found.r - nearly_as_high)
      found.others.push_back({(1 + rate) * shift, rate});
  }
  found.fall = found.r - least;
}

// --- beyond beginnings and ends ---

// Returns whether a signal rests over the first hundredth of its samples, or the last: the means of
// both halves of these differ by noise only.
bool rests(const Signal& s, bool at_the_end) {
  const std::size_t half = std::clamp<std::size_t>(s.value.size() / 200, 5, 50);
  if (s.value.size() < 4 * half) return false;
  const std::size_t from = at_the_end ? s.value.size() - 2 * half : 0;
  double apart = 0;
  for (std::size_t i = 0; i < half; ++i) apart += s.value[from + half + i] - s.value[from + i];
  const auto n = static_cast<double>(half);
  const Spread spread = spread_of(s);
  return std::abs(apart / n) <= std::max(0.01 * spread.range, 4 * spread.noise / std::sqrt(n));
}

bool all_rest(std::span<const Pair> pairs, bool at_the_end) {
  return std::ranges::all_of(pairs, [&](const Pair& p) {
    return rests(p.first, at_the_end) && rests(p.other, at_the_end);
  });
}

}  // namespace

std::optional<double> correlation_with_rest(std::span<const Pair> pairs, const Clock& clock) {
  const bool begins = all_rest(pairs, false), ends = all_rest(pairs, true);
  if (!begins && !ends) return std::nullopt;
  double sum = 0, count = 0;
  for (const Pair& p : pairs) {
    const double first[] = {p.first.time.front(), clock.first(p.other.time.front())};
    const double last[] = {p.first.time.back(), clock.first(p.other.time.back())};
    const double from = begins ? std::min(first[0], first[1]) : std::max(first[0], first[1]);
    const double to = ends ? std::max(last[0], last[1]) : std::min(last[0], last[1]);
    Reader a(p.first), b(p.other);
    Moments sums;
    for (double t = from; t <= to; t += p.first.step()) {
      const double other = std::clamp(clock.other(t), p.other.time.front(), p.other.time.back());
      sums.add(a.at(std::clamp(t, p.first.time.front(), p.first.time.back())), b.at(other));
    }
    const double r = sums.correlation();
    if (std::isfinite(r)) sum += r, count += 1;
  }
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

double longest_step(std::span<const Pair> pairs) {
  double step = 0;
  for (const Pair& p : pairs) step = std::max({step, p.first.step(), p.other.step()});
  return step;
}

std::optional<Correlation> overlap_correlation(std::span<const Pair> pairs, const Clock& clock,
                                               std::optional<Interval> within) {
  double sum = 0, count = 0;
  Correlation out;
  for (const Pair& pair : pairs) {
    std::size_t samples = 0;
    const double r = correlation_of(pair, clock, within, samples);
    if (!std::isfinite(r)) continue;
    out.samples = std::max(out.samples, samples);
    sum += r, count += 1;
  }
  if (count == 0) return std::nullopt;
  out.r = sum / count;
  return out;
}

std::optional<Found> search(std::span<const Pair> pairs, double most, bool rates) {
  double longest = 0, shorter = INFINITY;
  for (const Pair& p : pairs) {
    longest = std::max({longest, p.first.duration(), p.other.duration()});
    shorter = std::min({shorter, p.first.duration(), p.other.duration()});
  }
  const double step = std::max(longest_step(pairs), longest / most_steps);
  std::optional<Found> best;
  Shifts of_best;
  std::size_t top = 0;
  const int side = rates ? static_cast<int>(std::lround(most_rate / rate_step)) : 0;
  for (int i = -side; i <= side; ++i) {
    const double rate = i * rate_step;
    Shifts s = shifts_of(pairs, step, longest, rate);
    for (std::size_t k = 0; k < s.r.size(); ++k) {
      const double shift = (1 + rate) * (s.from + static_cast<double>(k) * step);
      if (std::abs(shift) > most) s.r[k] = NAN;
      if (!std::isfinite(s.r[k]) || (best && s.r[k] <= best->r)) continue;
      best = Found{.clock = {shift, rate}, .r = s.r[k]};
      top = k;
    }
    if (best && best->clock.rate == rate) of_best = std::move(s);
  }
  if (!best) return best;
  best->half_width = half_width(of_best, top);
  add_other_peaks(of_best, top, 0.1 * shorter, *best);
  return best;
}

namespace {

// Least-squares step of one channel: correction of the shift [s], and 1/variance of the shift.
struct Step {
  double by = 0, information = 0;
};

// Normal equations of a ~ alpha·b + beta + gamma·slope, with the means of all three removed.
struct Normal {
  double n = 0, a = 0, b = 0, c = 0, aa = 0, ab = 0, ac = 0, bb = 0, bc = 0, cc = 0;

  void add(double x, double y, double slope) {
    n += 1, a += x, b += y, c += slope;
    aa += x * x, ab += x * y, ac += x * slope, bb += y * y, bc += y * slope, cc += slope * slope;
  }
  Step step() const {
    const double vaa = aa - a * a / n, vab = ab - a * b / n, vac = ac - a * c / n;
    const double vbb = bb - b * b / n, vbc = bc - b * c / n, vcc = cc - c * c / n;
    const double det = vbb * vcc - vbc * vbc;
    if (!(n > 8) || !(det > 1e-9 * vbb * vcc)) return {};
    const double alpha = (vab * vcc - vac * vbc) / det, gamma = (vac * vbb - vab * vbc) / det;
    const double left = std::max(vaa - alpha * vab - gamma * vac, 1e-12 * vaa) / (n - 3);
    if (!(alpha > 0)) return {};
    return {gamma / alpha, alpha * alpha * det / vbb / left};
  }
};

Step step_of(const Pair& pair, const Clock& clock, double width, std::optional<Interval> within) {
  const std::vector<double>& time = pair.first.time;
  const double a0 = pair.first.value.front(), b0 = pair.other.value.front();
  Reader here(pair.other), before(pair.other), after(pair.other);
  Normal sums;
  std::size_t i = 0, end = time.size();
  if (within) {
    i = static_cast<std::size_t>(std::ranges::lower_bound(time, within->from) - time.begin());
    end = static_cast<std::size_t>(std::ranges::upper_bound(time, within->to) - time.begin());
  }
  for (; i < end; ++i) {
    const double t = clock.other(time[i]);
    if (!before.holds(t - width) || !after.holds(t + width)) continue;
    const double slope = (after.at(t + width) - before.at(t - width)) / (2 * width);
    sums.add(pair.first.value[i] - a0, here.at(t) - b0, slope);
  }
  return sums.step();
}

// Moves the shift to the vertex of the parabola, if it has a maximum.
void to_vertex(std::span<const Pair> pairs, Clock& clock, double width,
               std::optional<Interval> within) {
  const auto r = [&](double by) {
    return overlap_correlation(pairs, {clock.shift + by, clock.rate}, within)
        .value_or(Correlation{NAN, 0})
        .r;
  };
  const double before = r(-width), after = r(width), bend = before - 2 * r(0) + after;
  if (bend < 0) clock.shift += std::clamp(0.5 * (before - after) / bend, -1.0, 1.0) * width;
}

}  // namespace

Peak refine(std::span<const Pair> pairs, Clock clock, double width,
            std::optional<Interval> within) {
  to_vertex(pairs, clock, width, within);
  double information = 0;
  for (int again = 0; again < 8; ++again) {
    double by = 0;
    information = 0;
    for (const Pair& pair : pairs) {
      const Step step = step_of(pair, clock, width, within);
      information += step.information;
      by += step.information * step.by;
    }
    if (!(information > 0)) break;
    clock.shift += std::clamp(by / information, -width, width);
    if (std::abs(by / information) < 1e-7 * width) break;
  }
  const auto found = overlap_correlation(pairs, clock, within);
  return {clock, found ? found->r : 0, information > 0 ? 1 / std::sqrt(information) : INFINITY};
}

}  // namespace sinew::analysis
