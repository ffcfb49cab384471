#include "sinew/identify/pair/pair_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sinew/identify/data/quality.h"
#include "sinew/identify/fit/refusal.h"

namespace sinew::identify {

namespace {

constexpr std::array columns{Wanted{.name = "time", .unit = "s", .doc = "of the sample"},
                             Wanted{.name = "force",
                                    .unit = "N",
                                    .least = 1e-3,
                                    .most = 1e6,
                                    .optional = true,
                                    .doc = "that moves the slide, along the displacement"},
                             Wanted{.name = "displacement",
                                    .unit = "m",
                                    .least = 1e-6,
                                    .most = 2,
                                    .optional = true,
                                    .doc = "of the slide from anywhere"},
                             Wanted{.name = "torque",
                                    .unit = "N m",
                                    .least = 1e-5,
                                    .most = 1e5,
                                    .optional = true,
                                    .doc = "that moves the joint, along the angle"},
                             Wanted{.name = "angle",
                                    .unit = "rad",
                                    .least = 1e-5,
                                    .most = 7,
                                    .optional = true,
                                    .doc = "of the joint from anywhere"},
                             Wanted{.name = "pressure_1",
                                    .unit = "Pa abs",
                                    .least = 5e4,
                                    .most = 5e6,
                                    .optional = true,
                                    .doc = "of the trapped air of one muscle"},
                             Wanted{.name = "pressure_2",
                                    .unit = "Pa abs",
                                    .least = 5e4,
                                    .most = 5e6,
                                    .optional = true,
                                    .doc = "of the trapped air of the other"}};

constexpr std::size_t least_samples = 100;

// Is the recording one of a joint? Throws Refusal where it is of neither kind, or of both.
bool is_rotary(const Measured& data) {
  const bool slide = data.has("force") && data.has("displacement");
  const bool joint = data.has("torque") && data.has("angle");
  if (slide != joint) return joint;
  throw Refusal(data.file,
                slide ? "force and displacement, and torque and angle too"
                      : "neither force and displacement nor torque and angle",
                "the one or the other", "names.force=NAME, names.displacement=NAME");
}

// Coefficients of the parabola through samples, about the first's time.
struct Sums {
  double s[5] = {}, y[3] = {};

  void add(double t, double value) {
    double power = 1;
    for (int k = 0; k < 5; ++k, power *= t) {
      s[k] += power;
      if (k < 3) y[k] += power * value;
    }
  }

  // Slope and twice the bend at t = 0, by Cramer's rule.
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

// The window holds five samples at least, so that a parabola averages something.
void differentiate(double window, PairRecord& r) {
  const std::size_t n = r.size();
  r.rate.resize(n);
  r.acceleration.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t from = i, to = i;
    while (from > 0 && (r.time[i] - r.time[from - 1] <= 0.5 * window || i - from < 2)) --from;
    while (to + 1 < n && (r.time[to + 1] - r.time[i] <= 0.5 * window || to - i < 2)) ++to;
    const double size = std::max(r.time[to] - r.time[i], r.time[i] - r.time[from]);
    Sums sums;
    for (std::size_t k = from; k <= to; ++k)
      sums.add((r.time[k] - r.time[i]) / size, r.at[k] - r.at[i]);
    const auto [slope, bend] = sums.rates();
    r.rate[i] = slope / size;
    r.acceleration[i] = bend / (size * size);
  }
}

double smallest_step(std::span<const double> values) {
  double out = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double step = std::abs(values[i] - values[i - 1]);
    if (step > 0) out = std::min(out, step);
  }
  return out;
}

// Something is missing where a step is much longer than the others.
void tell_gaps(PairRecord& r) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < r.size(); ++i) steps.push_back(r.time[i] - r.time[i - 1]);
  const double usual = median(steps);
  const auto gaps = std::ranges::count_if(steps, [&](double s) { return s > 10 * usual; });
  if (gaps > 0)
    r.notes.push_back(fmt::format("{}: {} gaps of more than ten samples", r.file, gaps));
}

}  // namespace

std::span<const Wanted> pair_columns() { return columns; }

PairRecord pair_record(const Measured& data, double window) {
  PairRecord out{.file = data.file, .rotary = is_rotary(data), .notes = data.notes};
  const char* at = out.rotary ? "angle" : "displacement";
  const char* effort = out.rotary ? "torque" : "force";
  if (data.rows() < least_samples)
    throw Refusal(data.file, fmt::format("{} samples", data.rows()),
                  fmt::format("at least {} of a motion", least_samples), "a longer recording");
  refuse_constant(data, at, 1e-7, "a pair that is moved", "the column, or the sensor");
  refuse_constant(data, effort, 1e-9, "what moves it", "the column, or the sensor");
  refuse_clipped(data, effort, "a smaller motion, or a sensor for larger loads");
  out.time = data["time"];
  out.at = data[at];
  out.effort = data[effort];
  for (const char* name : {"pressure_1", "pressure_2"})
    if (data.has(name)) out.pressure.push_back(data[name]);
  out.resolution = smallest_step(out.at);
  differentiate(window, out);
  tell_gaps(out);
  return out;
}

void pair_delayed(std::span<const double> time, std::span<const double> values, double delay,
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
