// analysis/align/correlation.h - the shift of a clock at which two recordings are most alike.
//
// The other recording's clock shows t_b = t_s + (1 + rho)·t when the first one's shows t.
//
//   r(t_s, rho) = cov(a, b')/sqrt(var(a)·var(b'))   b'(t) = b(t_s + (1 + rho)·t)
//
// over all samples of a within the time of b'; mean of the channels. The correlation r is 1 for
// equal shapes, independent of their scales and offsets. It is undefined if both overlap by less
// than half of the shorter one.
//
//   search    on a grid of at most 4096 steps r of all shifts and of rates within 2 %
//   vertex    of the parabola through r(t_s - w), r(t_s), r(t_s + w); w is a quarter of the peak's
//             half width, at least a sample's step
//   refine    from there a ~ alpha_1·b' + alpha_0 + alpha_2·db'/dt_s by least squares,
//             t_s += alpha_2/alpha_1, until it converges: to the maximum of r exactly, also of an
//             asymmetric peak; db'/dt_s over +-w
//   se(t_s)   sigma_a/(alpha_1·sqrt(S)), sigma_a that of the residuals, S = sum (db'/dt_s)^2 of the
//             part that is not a combination of b' and 1. A ramp, which has the same shape at every
//             shift, has S = 0
#pragma once

#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sinew/analysis/align/signal.h"

namespace sinew::analysis {

// The instant at which a channel crosses a level, or begins to move.
//
//   crossing   first t with u(t) = level, u below before it and above after it (">"; "<" reversed),
//              on the straight line between the two samples around
//   motion     first t with |u(t) - u_0| = band that is followed by two more samples beyond it;
//              u_0 is the median of the first five samples
//   band       max(5 % of range, 8 sigma), the greater one of both recordings (signal.h)
//   se(t)      max(sigma/|slope there|, step/sqrt(12)), standard uncertainty of the instant
//
// The default channel is the one with the least se_a^2 + se_b^2.

// An instant and its standard uncertainty [s].
struct Instant {
  double time = 0, uncertainty = 0;
};

// Returns the first crossing of a level; empty if the signal does not cross it.
std::optional<Instant> first_crossing(const Signal& signal, double level, bool upwards);

// Returns the first motion out of a band about the signal's initial value; empty if it stays within
// the band, or moves from the first samples on.
std::optional<Instant> first_motion(const Signal& signal, double band);

// The crossing of a level by a channel, written "/joint/elbow/angle > 10 deg".
struct Event {
  std::string channel;
  bool upwards = true;
  std::string level;  // with its unit, "10 deg"
};
// Reads an event. Throws config::Error if the text is not one.
Event parse_event(const std::string& text);

// One event in two recordings.
struct EventPair {
  Instant first, other;
  std::string words;  // "/joint/elbow/angle moves by 0.05 rad"
  // Return the difference of the clocks at the event, other less first, and its uncertainty  [s].
  double shift() const { return other.time - first.time; }
  double uncertainty() const;
};

// A channel of two recordings, equal in name and SI unit.
struct Pair {
  Signal first, other;
  std::string unit;
};

// Returns the most certain first motion; empty if no channel rests and then moves in both.
std::optional<EventPair> surest_motion(std::span<const Pair> pairs);

// The other recording's clock in relation to the first one's.
struct Clock {
  double shift = 0;  // its time when the first one shows 0 [s]
  double rate = 0;   // its rate less 1 [-]
  // Return the time of the other clock at one of the first, and the reverse  [s].
  double other(double first) const { return shift + (1 + rate) * first; }
  double first(double other) const { return (other - shift) / (1 + rate); }
};

// An interval of the first recording's time.
struct Interval {
  double from, to;  // [s]
};

// Correlation of two recordings.
struct Correlation {
  double r = 0;             // -1 to 1
  std::size_t samples = 0;  // samples that have a partner, in the channel with the most
};
// Returns the correlation under a clock, over the whole overlap or `within`; empty if no channel
// has enough common samples that change in both recordings.
std::optional<Correlation> overlap_correlation(std::span<const Pair> pairs, const Clock& clock,
                                               std::optional<Interval> within = {});

// The best of all shifts and rates.
struct Found {
  Clock clock = {};
  double r = 0;
  double half_width = 0;  // distance from the peak to half its height, over the shift [s]
  double fall = 0;        // fall of r within a tenth of the shorter recording [-]
  // Other peaks, further away than two half widths, within 0.05 of r.
  std::vector<Clock> others = {};
};
// Searches shifts up to `most` in magnitude [s], and rates too if `rates`. Returns empty if the
// recordings do not overlap enough at any shift.
std::optional<Found> search(std::span<const Pair> pairs, double most, bool rates);

// Returns the correlation over the union of both recordings, each extended by its first and last
// value. It distinguishes the shifts of a periodic motion by its beginning and end, if the machine
// rests there: a side at which it moves in either recording is not extended, but limited to the
// overlap. Returns empty if it rests on neither side.
std::optional<double> correlation_with_rest(std::span<const Pair> pairs, const Clock& clock);

// A local maximum of r over the shift.
struct Peak {
  Clock clock = {};
  double r = 0, uncertainty = 0;  // r, uncertainty of the shift [s]; infinite without a peak
};
// Returns the peak near a clock's shift; `width` is w  [s].
Peak refine(std::span<const Pair> pairs, Clock clock, double width,
            std::optional<Interval> within = {});

// Returns the longest mean step between samples of all signals  [s].
double longest_step(std::span<const Pair> pairs);

// Discrete Fourier transform of a power of two of values (Cooley and Tukey
// 1965), for correlations over all shifts at once.

// Computes X_k = sum x_i exp(-2 pi j i k/n) in place; backwards with the opposite sign, divided by
// n.
inline void transform(std::vector<std::complex<double>>& x, bool backwards) {
  const std::size_t n = x.size();

  // Reorders the values by the reversed bits of their index.
  for (std::size_t i = 1, k = 0; i < n; ++i) {
    std::size_t bit = n / 2;
    for (; k & bit; bit /= 2) k ^= bit;
    k ^= bit;
    if (i < k) std::swap(x[i], x[k]);
  }

  // Combines transforms of half the length in pairs.
  const double turn = (backwards ? 2 : -2) * std::numbers::pi;
  for (std::size_t length = 2; length <= n; length *= 2)
    for (std::size_t k = 0; k < length / 2; ++k) {
      const auto w = std::polar(1.0, turn * static_cast<double>(k) / static_cast<double>(length));
      for (std::size_t at = k; at < n; at += length) {
        const std::complex<double> even = x[at], odd = w * x[at + length / 2];
        x[at] = even + odd;
        x[at + length / 2] = even - odd;
      }
    }
  if (backwards)
    for (auto& value : x) value /= static_cast<double>(n);
}

}  // namespace sinew::analysis
