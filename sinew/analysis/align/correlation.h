// analysis/align/correlation.h - the shift of a clock at which two recordings are most alike.
//
// The other recording's clock shows t_b = t_s + (1 + rho)·t where the first one's shows t.
//
//   r(t_s, rho) = cov(a, b')/sqrt(var(a)·var(b'))   b'(t) = b(t_s + (1 + rho)·t)
//
// over all samples of a at which there is a b; mean of the channels. Normalised like this r, the
// correlation, is 1 for equal shapes, whatever their scales and offsets. Where both overlap by less
// than half of the shorter one, r has no meaning.
//
//   search    on a grid of at most 4096 steps r of all shifts and of rates within 2 %
//   vertex    of the parabola through r(t_s - w), r(t_s), r(t_s + w); w is a quarter of the peak's
//             half width, at least a sample's step
//   refine    from there a ~ alpha_1·b' + alpha_0 + alpha_2·db'/dt_s by least squares,
//             t_s += alpha_2/alpha_1, until it stays: the top of r exactly, also where the peak is
//             lopsided; db'/dt_s over +-w
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

// The instant at which something happens in a recording: a channel crosses
// a level, or begins to move.
//
//   crossing   first t with u(t) = level, u below before it and above after it (">"; "<":
//   reversed),
//              on the straight line between the two samples around
//   motion     first t with |u(t) - u_0| = band that is followed by two more samples beyond it;
//              u_0 is the median of the first five samples
//   band       max(5 % of range, 8 sigma), the greater one of both recordings (signal.h)
//   se(t)      max(sigma/|slope there|, step/sqrt(12)): how well a recording knows the instant
//
// Without a wish the channel is taken whose instants are the surest: least se_a^2 + se_b^2.

// An instant and how sure it is; both in s.
struct Instant {
  double time = 0, uncertainty = 0;
};

// The first crossing of a level; nothing where there is none.
std::optional<Instant> first_crossing(const Signal& signal, double level, bool upwards);

// The first motion out of a band about where the signal begins; nothing where it stays, or where it
// is on its way from the first samples on.
std::optional<Instant> first_motion(const Signal& signal, double band);

// A channel crosses a level, as people write it: "/joint/elbow/angle > 10 deg".
struct Event {
  std::string channel;
  bool upwards = true;
  std::string level;  // with its unit, "10 deg"
};
// Throws config::Error where the text is none.
Event parse_event(const std::string& text);

// One event in two recordings.
struct EventPair {
  Instant first, other;
  std::string words;  // "/joint/elbow/angle moves by 0.05 rad"
  // Returns by how much later the other one has it, and how sure that is  [s].
  double shift() const { return other.time - first.time; }
  double uncertainty() const;
};

// A channel of two recordings, by name and SI unit.
struct Pair {
  Signal first, other;
  std::string unit;
};

// The surest first motion; nothing where no channel stands still and then moves in both.
std::optional<EventPair> surest_motion(std::span<const Pair> pairs);

// How the other recording's clock goes beside the first one's.
struct Clock {
  double shift = 0;  // what it shows where the first one shows 0 [s]
  double rate = 0;   // by how much faster it goes [-]
  // Return the time of the other clock at one of the first, and the reverse  [s].
  double other(double first) const { return shift + (1 + rate) * first; }
  double first(double other) const { return (other - shift) / (1 + rate); }
};

// Where an interval of the first one's time is looked at; everything, without one.
struct Interval {
  double from, to;  // [s]
};

// How alike two recordings are.
struct Likeness {
  double r = 0;             // -1 to 1
  std::size_t samples = 0;  // that have a partner; of the channel with the most
};
// Returns how alike both are under a clock; nothing where too few samples meet, or a channel does
// not change there in either.
std::optional<Likeness> likeness(std::span<const Pair> pairs, const Clock& clock,
                                 std::optional<Interval> within = {});

// The best of all shifts and rates.
struct Found {
  Clock clock = {};
  double r = 0;
  double half_width = 0;  // of the peak over the shift, where r is half as high [s]
  double fall = 0;        // of r within a tenth of the shorter recording [-]
  // Other peaks, further away than two half widths, that are nearly as high: within 0.05.
  std::vector<Clock> others = {};
};
// Searches shifts up to `most` in magnitude [s], and rates too where `rates`. Nothing where no
// shift lets them overlap.
std::optional<Found> search(std::span<const Pair> pairs, double most, bool rates);

// A motion that repeats itself fits at other shifts as well, but for where it begins and ends: a
// recording that does so at rest says that the machine stood still before, or after. Returns how
// alike both are from the first beginning to the last end, each standing still beyond its own; from
// the later beginning, or to the earlier end, where one is on its way then. Nothing where both are.
std::optional<double> likeness_at_rest(std::span<const Pair> pairs, const Clock& clock);

// A shift at which both are most alike.
struct Peak {
  Clock clock = {};
  double r = 0, uncertainty = 0;  // of the shift [s]; infinite where there is no peak
};
// The peak about a clock's shift; `width` is w  [s].
Peak refine(std::span<const Pair> pairs, Clock clock, double width,
            std::optional<Interval> within = {});

// The longest step between samples of any of them  [s].
double longest_step(std::span<const Pair> pairs);

// Discrete Fourier transform of a power of two of values (Cooley and Tukey
// 1965), for correlations over all shifts at once.

// X_k = sum x_i exp(-2 pi j i k/n), in place; backwards with the opposite sign, divided by n.
inline void transform(std::vector<std::complex<double>>& x, bool backwards) {
  const std::size_t n = x.size();

  // Values go to where their place's bits, read backwards, point.
  for (std::size_t i = 1, k = 0; i < n; ++i) {
    std::size_t bit = n / 2;
    for (; k & bit; bit /= 2) k ^= bit;
    k ^= bit;
    if (i < k) std::swap(x[i], x[k]);
  }

  // Transforms of twice the length from two of half of it.
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
