// actuator/prediction.h - within which distance of the law's force a measured one lies.
//
//   half-width^2 = inside^2 + (between^2 - inside^2) a^2    between the ends of what was measured
//   half-width   = inside + (beyond - inside) d/0.2         beyond them
//
//   inside, between, beyond  half-widths that hold 68 or 95 % of measured forces [N]
//   a  distance of the next length that was measured, in parts of half the widest gap between two
//   of
//      them: 0 at such a length, 1 halfway in that gap [-]
//   d  how far beyond the lengths or the pressures, in parts of their range; the larger one [-]
//
// The identification that wrote them counted the forces that it had not seen
// (identify/actuator/static_spread.h). Beyond one range further nothing is known.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "sinew/actuator/actuator.h"

namespace sinew::actuator {

inline constexpr double same_length = 0.004;  // of the longest: closer than that is that length

// Half-widths at a point  [N].
struct ForceInterval {
  double half_68 = 0, half_95 = 0;
  bool known = false;    // false: nobody measured so far from there, or at all
  bool measured = true;  // false: beyond what was measured
};

// Returns how far x lies beyond the ends, in parts of their range  [-].
inline double beyond_ends(double x, double low, double high) {
  const double range = high - low;
  const double off = std::max({low - x, x - high, 0.0});
  if (!(range > 0)) return off > 1e-9 * std::max(std::abs(low), 1e-9) ? 2.0 : 0.0;
  return off > 1e-9 * range ? off / range : 0.0;
}

// Returns the distance of the next of some lengths, which are in ascending order  [m].
inline double next_length(const std::vector<double>& lengths, double length) {
  double out = std::numeric_limits<double>::infinity();
  for (const double l : lengths) out = std::min(out, std::abs(l - length));
  return out;
}

// Returns the widest gap between two neighbours of some lengths in ascending order  [m].
inline double widest_gap(const std::vector<double>& lengths) {
  double out = 0;
  for (std::size_t i = 1; i < lengths.size(); ++i) out = std::max(out, lengths[i] - lengths[i - 1]);
  return out;
}

// Returns the interval about the law's tension at a length [m] and a gauge pressure [Pa].
inline ForceInterval force_interval(const Prediction& p, double length, double gauge_pressure) {
  ForceInterval out;
  if (!(p.inside_95 > 0) || p.lengths.empty()) return out;
  const double off = beyond_ends(length, p.lengths.front(), p.lengths.back());
  const double d = std::max(off, beyond_ends(gauge_pressure, p.lowest, p.highest));
  const double away = off > 0 ? 0 : next_length(p.lengths, length);
  const double a = away > 0 ? away / (0.5 * widest_gap(p.lengths)) : 0;
  out.measured = d == 0;
  out.known = (out.measured || (p.beyond_95 > 0 && d <= 1.0)) &&
              (p.between_95 > 0 || away < same_length * p.lengths.back());
  if (!out.known) return out;
  const auto at = [a, d](double inside, double between, double beyond) {
    if (d > 0) return inside + std::max(0.0, beyond - inside) * d / 0.2;
    return std::sqrt(inside * inside + std::max(0.0, between * between - inside * inside) * a * a);
  };
  out.half_68 = at(p.inside_68, p.between_68, p.beyond_68);
  out.half_95 = at(p.inside_95, p.between_95, p.beyond_95);
  return out;
}

}  // namespace sinew::actuator
