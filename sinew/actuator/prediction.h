// actuator/prediction.h - within which distance of the law's force a measured one lies.
//
//   half-width = inside                                     between the ends of what was measured
//              = inside + (beyond - inside) d/0.2           beyond them
//
//   inside, beyond  half-widths that hold 68 or 95 % of measured forces [N]
//   d  how far beyond the lengths or the pressures, in parts of their range; the larger one [-]
//
// The identification that wrote them counted the forces that it had not seen
// (identify/actuator/static_spread.h). Beyond one range further nothing is known.
#pragma once

#include <algorithm>
#include <cmath>

#include "sinew/actuator/actuator.h"

namespace sinew::actuator {

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

// Returns the interval about the law's tension at a length [m] and a gauge pressure [Pa].
inline ForceInterval force_interval(const Prediction& p, double length, double gauge_pressure) {
  ForceInterval out;
  if (!(p.inside_95 > 0)) return out;
  const double d = std::max(beyond_ends(length, p.shortest, p.longest),
                            beyond_ends(gauge_pressure, p.lowest, p.highest));
  out.measured = d == 0;
  out.known = out.measured || (p.beyond_95 > 0 && d <= 1.0);
  if (!out.known) return out;
  const auto at = [d](double inside, double beyond) {
    return d == 0 ? inside : inside + std::max(0.0, beyond - inside) * d / 0.2;
  };
  out.half_68 = at(p.inside_68, p.beyond_68);
  out.half_95 = at(p.inside_95, p.beyond_95);
  return out;
}

}  // namespace sinew::actuator
