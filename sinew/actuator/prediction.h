// actuator/prediction.h - interval about the law's force that contains measured forces.
//
//   half-width = base + max((beyond - inside) d/0.2, (above - inside) e/0.2, 0)
//   base^2     = inside^2 + (between^2 - inside^2) a + (b F)^2
//
//   inside, between, beyond, above  half-widths that hold 68 or 95 % of measured forces: at a
//       measured length, halfway in the widest gap between two, a fifth of the range beyond the
//       lengths, and a fifth of the range beyond the pressures [N]
//   a  harmonic mean of the distances to the measured lengths on either side, relative to half the
//      widest gap: 1 in the middle of that gap, 0 at the measured lengths and beyond the ends [-]
//   b, F  share of the force, per_force_68 or per_force_95 [-], and the law's force [N]
//   d, e  distance beyond the lengths and the pressures, relative to their ranges [-]
//
// The half-widths are counted by the identification from forces that its fit had not seen
// (identify/actuator/static_spread.h). Nothing is known further than one range beyond, nor beyond
// the longest mount: the bladder is steepest there, and the threads stretch.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "sinew/actuator/actuator.h"

namespace sinew::actuator {

// Relative difference of lengths, to the longest, below which they are one mount [-].
inline constexpr double same_length = 0.004;

// Half-widths at a point  [N].
struct ForceInterval {
  double half_68 = 0, half_95 = 0;
  bool known = false;    // false: too far from any measurement, or no measurements
  bool measured = true;  // false: outside the measured range
};

// Returns the distance of x beyond the ends, relative to their range [-].
inline double beyond_ends(double x, double low, double high) {
  const double range = high - low;
  const double off = std::max({low - x, x - high, 0.0});
  if (!(range > 0)) return off > 1e-9 * std::max(std::abs(low), 1e-9) ? 2.0 : 0.0;
  return off > 1e-9 * range ? off / range : 0.0;
}

// The nearest of some lengths on either side of one; infinite beyond their ends [m].
struct Neighbours {
  double below = -std::numeric_limits<double>::infinity();
  double above = std::numeric_limits<double>::infinity();
};

// Returns the neighbours of a length; both are the length itself if it is one of them.
inline Neighbours neighbours_of(const std::vector<double>& lengths, double length) {
  Neighbours out;
  for (const double l : lengths) {
    if (l <= length) out.below = std::max(out.below, l);
    if (l >= length) out.above = std::min(out.above, l);
  }
  return out;
}

// Returns the harmonic mean of the distances to both neighbours [m]: 0 at a length, half the gap in
// its middle, twice the distance beyond the ends.
inline double harmonic_distance(const std::vector<double>& lengths, double length) {
  const Neighbours n = neighbours_of(lengths, length);
  const double a = length - n.below, b = n.above - length;
  return a > 0 && b > 0 ? 2 / (1 / a + 1 / b) : 0;
}

// Returns the widest gap between neighbours of some lengths in ascending order [m].
inline double widest_gap(const std::vector<double>& lengths) {
  double out = 0;
  for (std::size_t i = 1; i < lengths.size(); ++i) out = std::max(out, lengths[i] - lengths[i - 1]);
  return out;
}

// Return the widest half-widths within the measured range, at a force of the law [N]; 0: unknown.
inline double widest_inside_68(const Prediction& p, double force) {
  return p.inside_68 > 0 ? std::hypot(std::max(p.inside_68, p.between_68), p.per_force_68 * force)
                         : 0;
}
inline double widest_inside_95(const Prediction& p, double force) {
  return p.inside_95 > 0 ? std::hypot(std::max(p.inside_95, p.between_95), p.per_force_95 * force)
                         : 0;
}

// Returns the interval about the law's tension [N] at a length [m] and a gauge pressure [Pa].
inline ForceInterval force_interval(const Prediction& p, double length, double gauge_pressure,
                                    double tension) {
  ForceInterval out;
  if (!(p.inside_95 > 0) || p.lengths.empty()) return out;
  const double d = beyond_ends(length, p.lengths.front(), p.lengths.back());
  const double e = beyond_ends(gauge_pressure, p.lowest, p.highest);
  const double gap = widest_gap(p.lengths);
  const double away = d == 0 && gap > 0 ? harmonic_distance(p.lengths, length) : 0;
  const double a = gap > 0 ? away / (0.5 * gap) : 0;
  out.measured = d == 0 && e == 0;
  const bool unseen = length > (1 + same_length) * p.lengths.back();
  out.known = (d == 0 || (p.beyond_95 > 0 && d <= 1 && !unseen)) &&
              (e == 0 || (p.above_95 > 0 && e <= 1)) &&
              (p.between_95 > 0 || away < 2 * same_length * p.lengths.back());
  if (!out.known) return out;
  const auto at = [a, d, e](double inside, double between, double beyond, double above,
                            double of_force) {
    const double form = std::max(0.0, between * between - inside * inside) * a;
    return std::sqrt(inside * inside + form + of_force * of_force) +
           std::max({0.0, (beyond - inside) * d / 0.2, (above - inside) * e / 0.2});
  };
  out.half_68 = at(p.inside_68, p.between_68, p.beyond_68, p.above_68, p.per_force_68 * tension);
  out.half_95 = at(p.inside_95, p.between_95, p.beyond_95, p.above_95, p.per_force_95 * tension);
  return out;
}

}  // namespace sinew::actuator
