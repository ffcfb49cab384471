#include "sinew/identify/motion/turns.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "sinew/identify/contest/matrix.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/data/quality.h"

namespace sinew::identify {

namespace {

using Values = std::vector<double>;

constexpr double samples_per_period = 20;
constexpr double fit_within = 1.0 / 6;  // share of a period, on either side of a turn

// Returns the standard deviation of one sample, from fourth differences, which hardly contain the
// oscillation; at least the rounding error of the resolution.
double noise_of(std::span<const double> x) {
  Values fourth, steps;
  for (std::size_t i = 4; i < x.size(); ++i)
    fourth.push_back(x[i] - 4 * x[i - 1] + 6 * x[i - 2] - 4 * x[i - 3] + x[i - 4]);
  double resolution = std::numeric_limits<double>::infinity();
  for (const double step : steps_of(x))
    if (step != 0) resolution = std::min(resolution, std::abs(step));
  if (!std::isfinite(resolution)) resolution = 0;
  return std::max(spread(fourth) / std::sqrt(70.0), resolution / std::sqrt(12.0));
}

// Returns running medians over five samples.
Values median_of_five(std::span<const double> x) {
  Values out(x.begin(), x.end());
  for (std::size_t i = 2; i + 2 < x.size(); ++i) out[i] = median(x.subspan(i - 2, 5));
  return out;
}

Values moving_mean(const Values& x, std::size_t half) {
  Values out;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const std::size_t reach = std::min({half, i, x.size() - 1 - i});
    double sum = 0;
    for (std::size_t k = i - reach; k <= i + reach; ++k) sum += x[k];
    out.push_back(sum / static_cast<double>(2 * reach + 1));
  }
  return out;
}

// Extremes from which the signal moves back by more than `back`, alternately upper and lower.
struct Extreme {
  std::size_t at;
  bool upper;
};
std::vector<Extreme> extremes(const Values& x, double back) {
  std::vector<Extreme> out;
  std::size_t high = 0, low = 0;
  for (std::size_t i = 1; i < x.size(); ++i) {
    if (x[i] > x[high]) high = i;
    if (x[i] < x[low]) low = i;
    const bool may_fall = out.empty() || !out.back().upper;
    const bool may_rise = out.empty() || out.back().upper;
    if (may_fall && x[i] < x[high] - back) {
      out.push_back({high, true});
      low = i;
    } else if (may_rise && x[i] > x[low] + back) {
      out.push_back({low, false});
      high = i;
    }
  }
  return out;
}

double period_of(std::span<const double> time, const std::vector<Extreme>& at) {
  // The first interval may include the time before the release.
  Values halves;
  for (std::size_t i = at.size() > 3 ? 2 : 1; i < at.size(); ++i)
    halves.push_back(time[at[i].at] - time[at[i - 1].at]);
  return 2 * median(halves);
}

// Least squares polynomial of fourth order in u = (t - origin)/reach.
class Quartic {
 public:
  void add(double u, double x) {
    const std::array<double, 5> row = {1, u, u * u, u * u * u, u * u * u * u};
    for (std::size_t i = 0; i < row.size(); ++i) {
      for (std::size_t k = 0; k < row.size(); ++k) normal_(i, k) += row[i] * row[k];
      right_[i] += row[i] * x;
    }
    ++count_;
  }

  // Returns the vertex between -1 and 1, searched from u = 0; empty if it is of the other kind.
  std::optional<double> vertex(bool upper) const {
    if (count_ < 6) return std::nullopt;
    const std::vector<double> p = solved(normal_, right_);
    double u = 0;
    for (int k = 0; k < 20; ++k) {
      const double slope = p[1] + u * (2 * p[2] + u * (3 * p[3] + u * 4 * p[4]));
      if (upper ? bend(p, u) >= 0 : bend(p, u) <= 0) return std::nullopt;
      u = std::clamp(u - slope / bend(p, u), -1.0, 1.0);
    }
    return u;
  }

  // Returns the value at a vertex. Noise of the slope moves the vertex; the mean error is the
  // variance of the slope over twice the bend.
  double at_vertex(double u, double noise) const {
    const std::vector<double> p = solved(normal_, right_);
    const std::array<double, 5> slope = {0, 1, 2 * u, 3 * u * u, 4 * u * u * u};
    const double variance = noise * noise * dot(slope, solved(normal_, slope));
    return p[0] + u * (p[1] + u * (p[2] + u * (p[3] + u * p[4]))) + variance / (2 * bend(p, u));
  }

 private:
  static double bend(std::span<const double> p, double u) {
    return 2 * p[2] + u * (6 * p[3] + u * 12 * p[4]);
  }

  int count_ = 0;
  Matrix normal_ = Matrix(5, 5);
  std::array<double, 5> right_{};
};

struct Record {
  std::span<const double> time, value;
  const Values& clean;  // values without spikes
  double outlier;       // distance from `clean` beyond which a sample is an outlier
  double noise;         // noise of a value
};

Quartic fitted(const Record& r, double origin, double level, double reach) {
  Quartic fit;
  const auto first = std::lower_bound(r.time.begin(), r.time.end(), origin - reach);
  for (auto i = static_cast<std::size_t>(first - r.time.begin());
       i < r.time.size() && r.time[i] <= origin + reach; ++i)
    if (std::abs(r.value[i] - r.clean[i]) <= r.outlier)
      fit.add((r.time[i] - origin) / reach, r.value[i] - level);
  return fit;
}

// Returns the turn near an extreme; empty if the fit has it elsewhere.
std::optional<Turn> refined(const Record& r, Extreme e, double reach) {
  const double origin = r.time[e.at], level = r.clean[e.at];
  const Quartic fit = fitted(r, origin, level, reach);
  const auto u = fit.vertex(e.upper);
  if (!u || std::abs(*u) > 0.7) return std::nullopt;
  return Turn{origin + *u * reach, level + fit.at_vertex(*u, r.noise), e.upper};
}

// Returns the turn from which a mass was released at about the start of the record. Empty if the
// record begins during the motion.
std::optional<Turn> release_turn(const Record& r, bool upper, double reach) {
  const double begin = r.time[0], level = r.clean[0];
  const Quartic fit = fitted(r, begin, level, reach);
  const auto u = fit.vertex(upper);
  if (!u || *u < -0.1) return std::nullopt;
  const double turn = std::max(*u, 0.0);
  return Turn{begin + turn * reach, level + fit.at_vertex(turn, r.noise), upper};
}

// Returns the first turn. Before it the mass may have been held, or there may be no samples.
std::optional<Turn> first_turn(const Record& r, Extreme e, const Oscillation& o, double swing) {
  // After an eighth of its period a cosine has done 15 % of its way from top to bottom.
  const double release = r.time[o.falls] - o.period / 8, reach = o.period * fit_within;
  if (release - r.time[0] < reach) return release_turn(r, e.upper, o.period / 4);
  Values before;
  for (std::size_t i = 0; r.time[i] < release; ++i)
    if (r.time[i] >= release - o.period / 4) before.push_back(r.clean[i]);
  // A held mass has a constant value; otherwise it is a turn like every later one.
  const bool level = largest(before) - smallest(before) < 0.05 * swing + 6 * o.noise;
  return level ? Turn{release, median(before), e.upper} : refined(r, e, reach);
}

// Refuses samples that repeat the record's extreme exactly, for long or in several swings: a
// decay does not reach the same value twice.
void refuse_clipped_swings(std::span<const double> time, std::span<const double> value,
                           double period, const std::string& subject) {
  for (const double extreme : {largest(value), smallest(value)}) {
    int swings = 0, count = 0;
    double longest = 0, last_end = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < value.size(); ++i) {
      if (value[i] != extreme) continue;
      std::size_t end = i;
      while (end + 1 < value.size() && value[end + 1] == extreme) ++end;
      const bool touches_edge = i == 0 || end + 1 == value.size();
      const auto length = static_cast<int>(end - i + 1);
      if (length >= 3 && !touches_edge) {
        if (time[i] - last_end > period / 2) ++swings;
        longest = std::max(longest, time[end] - time[i]);
        count += length;
        last_end = time[end];
      }
      i = end;
    }
    if (longest > period / 8 || swings > 1)
      throw Refusal(subject,
                    fmt::format("{} samples that stay at {:.6g} in {} swing{}: the sensor or its "
                                "converter is at its end",
                                count, extreme, swings, swings == 1 ? "" : "s"),
                    "swings within its range", "a smaller displacement");
  }
}

[[noreturn]] void refuse_still(const std::string& subject, std::size_t turns) {
  throw Refusal(subject, fmt::format("{} turning point{}", turns, turns == 1 ? "" : "s"),
                "at least 5 in a free decay: two full periods",
                "a longer record, a larger displacement, or more mass");
}

}  // namespace

Oscillation find_turns(std::span<const double> time, std::span<const double> value,
                       const std::string& subject) {
  Oscillation out{.noise = noise_of(value)};
  const double range = largest(value) - smallest(value);
  if (value.size() < 40 || !(range > 10 * out.noise)) refuse_still(subject, 0);

  // Roughly first, to find the period; then smoothed by a sixteenth of the period.
  const Values clean = median_of_five(value);
  const std::vector<Extreme> rough =
      extremes(moving_mean(clean, 2), std::max(6 * out.noise, 0.05 * range));
  if (rough.size() < 5) refuse_still(subject, rough.size());
  const double rough_period = period_of(time, rough);
  const double per_period = rough_period / median(steps_of(time));
  if (per_period < samples_per_period)
    throw Refusal(subject, fmt::format("{:.0f} samples per period", per_period),
                  fmt::format("at least {:.0f}", samples_per_period), "a faster recording");
  refuse_clipped_swings(time, value, rough_period, subject);

  const auto half = static_cast<std::size_t>(per_period / 32);
  const Values smooth = moving_mean(clean, half);
  const double smooth_noise = out.noise / std::sqrt(2.0 * static_cast<double>(half) + 1);
  const std::vector<Extreme> found = extremes(smooth, std::max(8 * smooth_noise, 0.002 * range));
  if (found.size() < 5) refuse_still(subject, found.size());
  out.period = period_of(time, found);

  const double swing = std::abs(smooth[found[1].at] - smooth[found[0].at]);
  out.falls = found[0].at;
  while (std::abs(smooth[out.falls] - smooth[found[1].at]) > 0.85 * swing) ++out.falls;

  const Record record{time, value, clean, 6 * out.noise + 1e-3 * swing, out.noise};
  for (std::size_t i = 0; i < value.size(); ++i)
    out.spike.push_back(std::abs(value[i] - clean[i]) > record.outlier);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto turn = i == 0 ? first_turn(record, found[0], out, swing)
                             : refined(record, found[i], out.period * fit_within);
    if (turn) out.turns.push_back(*turn);
    if (!turn && i > 0) break;
  }
  if (out.turns.size() < 5) refuse_still(subject, out.turns.size());
  // Only the large swings are used: dry friction distorts the small ones at their turns.
  Values periods;
  for (std::size_t i = 3; i < std::min<std::size_t>(out.turns.size(), 8); ++i)
    periods.push_back(out.turns[i].time - out.turns[i - 2].time);
  out.period = median(periods);

  // Remaining samples after the last turn, if long enough to be at rest and not in a slow turn.
  Values after;
  for (std::size_t i = 0; i < time.size(); ++i)
    if (time[i] > out.turns.back().time + 0.75 * out.period) after.push_back(value[i]);
  const double lasts = time.back() - out.turns.back().time - 0.75 * out.period;
  out.rest = lasts > 0.5 * out.period ? median(after) : std::numeric_limits<double>::quiet_NaN();
  return out;
}

}  // namespace sinew::identify
