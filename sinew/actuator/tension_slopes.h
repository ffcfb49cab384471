// actuator/tension_slopes.h - derivatives of an actuator's tension by its parameters, length and
// pressure, in closed form, for searches that fit the law to measurements.
//
//   B(x)   pull of braid and bladder, pull.h        F = F_t(B)       x = L - C_s F, series.h
//
//   dF/dq = s dB/dq       s = F_t'/(1 + C_s F_t' dB/dx)       dF/dL = s dB/dx
//   dF/dC_s = -F dF/dL    dF/dF_toe = (F - F_t' B)/F_toe / (1 + C_s F_t' dB/dx)
//
//   q  a parameter, or the pressure
//
// Valid within the lengths and pressures of bladder and effectiveness, above the shortest length,
// below the long end, without velocity.
#pragma once

#include <numbers>

#include "sinew/actuator/tension.h"

namespace sinew::actuator {

// Derivatives of a tension by length and pressure  [N/m], [N/Pa].
struct TensionSlopes {
  double by_length = 0, by_pressure = 0;
};

// Writes the derivatives of the wall's tension by thread length, turns and thickness. `per_area` is
// the derivative of the tension by its area [N/m2].
inline void add_wall_slopes(const Actuator& a, double x, double per_area, Actuator& by) {
  const double t = a.wall.thickness, b = a.braid.thread_length, d = widest_diameter(a.braid);
  const double s = braid_sine(a.braid, x), shape = 2 * s - 1 / s,
               each = per_area * std::numbers::pi;
  by.wall.thickness = each * (d * shape - 2 * t);
  const double by_sine = s > 0.1 ? x * x / (b * b * b * s) * (2 + 1 / (s * s)) : 0;
  by.braid.thread_length += each * t * d * (shape / b + by_sine);
  by.braid.turns -= each * t * d * shape / a.braid.turns;
}

// Writes the derivatives by the bladder's parameters except its rest length. `share` is the
// derivative of the tension by the bladder's tension.
inline void write_bladder_slopes(const Bladder& b, double x, double share, Bladder& by) {
  const double u = held(b, x) - b.rest_length, v = u / b.saturation_length;
  const double e = v < 0 ? units::exp(v > -700 ? v : -700) : 1;
  by.stiffness = share * u;
  by.quadratic = share * u * u;
  by.cubic = share * u * u * u;
  by.saturating_tension = share * (v < 0 ? e - 1 : v);
  by.saturation_length = -share * b.saturating_tension * e * v / b.saturation_length;
}

// Returns the slopes of `tension`, which must be clamped_tension() at this point, and writes its
// derivative by each parameter to that parameter's place in `by`.
inline TensionSlopes tension_slopes(const Actuator& a, double length, double p, double atmosphere,
                                    double tension, Actuator& by) {
  const Effectiveness& e = a.effectiveness;
  const double x = length - a.series.compliance * tension;
  const double kappa = taper_gain(a.taper, p), w = working_length(a, x, p);

  // Pull of braid and bladder, and its slopes over the length and over the area of the braid.
  const double acting = acting_pressure(e, p), eff = effectiveness(e, p, atmosphere);
  const double area = ideal_tension(a.braid, w, 1) + wall_area(a, w);
  const double by_w = acting * eff * (ideal_stiffness(a.braid, w, 1) + wall_area_slope(a, w));
  const BladderPull bladder = bladder_pull(a.bladder, x);
  const double pull = acting * eff * area + bladder.tension;
  const ToePull toe = toe_pull(a.toe, pull);
  const double steep = by_w * kappa + bladder.stiffness;
  const double left = 1 / (1 + a.series.compliance * toe.share * steep), s = toe.share * left;
  TensionSlopes out{.by_length = s * steep};

  const double per_area = s * acting * eff;
  by.braid.thread_length = -2 * per_area * a.braid.thread_length * braid_factor(a.braid);
  by.braid.turns = -2 / a.braid.turns * per_area * ideal_tension(a.braid, w, 1);
  add_wall_slopes(a, w, per_area, by);
  const bool taut = p > e.threshold;
  by.effectiveness.threshold = taut ? -s * eff * area : 0;
  by.effectiveness.c0 = s * acting * area * e.scale;
  by.effectiveness.c1 = by.effectiveness.c0 * p;
  by.effectiveness.c2 = by.effectiveness.c1 * p;
  by.effectiveness.scale = s * acting * area * (e.c0 + p * (e.c1 + p * e.c2));
  by.caps.length = -s * by_w;
  write_bladder_slopes(a.bladder, x, s, by.bladder);
  by.bladder.rest_length = -s * bladder.stiffness;
  by.series.compliance = -tension * out.by_length;
  by.toe.tension = a.toe.tension > 0 ? left * (tension - toe.share * pull) / a.toe.tension : 0;
  out.by_pressure =
      (taut || p < 0 ? s * eff * area : 0) + s * acting * area * e.scale * (e.c1 + 2 * p * e.c2);

  const bool narrows = tapers(a.taper);
  const double late = a.taper.extra_pressure;
  const double fade = narrows && p > 0 ? units::exp(p < 700 * late ? -p / late : -700) : 1;
  by.taper.gain = -s * by_w * (a.taper.rest_length - x);
  by.taper.extra_gain = by.taper.gain * fade;
  by.taper.extra_pressure =
      p > 0 ? by.taper.extra_gain * a.taper.extra_gain * p / (late * late) : 0;
  by.taper.rest_length = s * by_w * (1 - kappa);
  if (narrows && p > 0) out.by_pressure -= by.taper.extra_gain * a.taper.extra_gain / late;
  return out;
}

}  // namespace sinew::actuator
