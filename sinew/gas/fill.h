// gas/fill.h - how long a valve takes to fill or vent a rigid volume: for design, not for the loop.
//
//   t = integral of V d(rho)/m'(P)  from P_1 to P_2,   d(rho)/dP = rho/(n_p P)            [38]-[40]
//
// Closed forms where the flow is choked, G_c = A C_m / sqrt(T):
//
//   filling           m' = G_c P_supply      t = V (rho_2 - rho_1)/(G_c P_supply)
//   venting, n_p = 1  m' = G_c P             t = V/(G_c R T) log(P_1/P_2)
//
// The rest is integrated over s = log|P - P_port|, which makes the slow end at P_port harmless, in
// pieces that end where the law has a kink (choking, linear part), each by Simpson's rule doubled
// until it stands still: deterministic, relative error below 1e-9 (tested).
//
// Without the valve's opening delay; a volume that moves or hoses that resist take longer.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "sinew/gas/air.h"
#include "sinew/gas/orifice.h"
#include "sinew/gas/valve.h"

namespace sinew::gas {

// Integral of f from a to b for a smooth f.
template <class Function>
double integral(const Function& f, double a, double b) {
  if (a == b) return 0.0;
  double step = b - a;
  double trapezoid = 0.5 * step * (f(a) + f(b));
  double simpson = trapezoid;

  for (int intervals = 1; intervals <= 1 << 14; intervals *= 2) {
    double middles = 0;
    for (int i = 0; i < intervals; ++i) middles += f(a + (i + 0.5) * step);
    const double finer = 0.5 * (trapezoid + step * middles);
    const double better = (4.0 * finer - trapezoid) / 3.0;
    const double change = std::abs(better - simpson);

    step *= 0.5;
    trapezoid = finer;
    simpson = better;
    if (intervals >= 8 && change <= 1e-11 * std::abs(better)) break;
  }
  return simpson;
}

// Time in which a chamber goes `from` one pressure `to` another while the open valve joins it to a
// port of constant pressure, all absolute  [s]. Infinite where the port cannot bring it there, the
// port's own pressure included: near it the flow is linear and the approach exponential.
inline double transfer_time(const Flow& flow, const Air& air, double volume, double port,
                            double from, double to) {
  if (from == to) return 0.0;
  const double side = to > from ? -1.0 : 1.0;  // of the port on which the chamber is
  const bool shut = mass_flow(flow, air, port, from) == 0.0;
  if (shut || !(side * (to - port) > 0)) return std::numeric_limits<double>::infinity();

  // Distances |P - port| of start, kinks and end, descending.
  const double critical = critical_ratio(flow);
  const double start = side * (from - port), end = side * (to - port);
  const auto kink = [&](double ratio) {
    const double distance = side < 0 ? port * (1.0 - ratio) : port * (1.0 / ratio - 1.0);
    return distance > start ? start : distance < end ? end : distance;
  };
  const std::array<double, 4> nodes{start, critical > 0 ? kink(critical) : start,
                                    kink(1.0 - flow.linear_below), end};

  const auto slowness = [&](double s) {
    const double distance = units::exp(s);
    const double p = port + side * distance;
    const double slope = density(air, p) / (air.polytropic_exponent * p);
    return volume * slope * distance / std::abs(mass_flow(flow, air, port, p));
  };
  double time = 0;
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    if (nodes[i] > nodes[i + 1]) {
      time += integral(slowness, units::log(nodes[i + 1]), units::log(nodes[i]));
    }
  }
  return time;
}

// From the supply  [s].
inline double fill_time(const Flow& flow, const Air& air, double volume, double supply, double from,
                        double to) {
  return to >= from ? transfer_time(flow, air, volume, supply, from, to)
                    : std::numeric_limits<double>::infinity();
}

// To the atmosphere  [s].
inline double vent_time(const Flow& flow, const Air& air, double volume, double from, double to) {
  return to <= from ? transfer_time(flow, air, volume, air.atmosphere, from, to)
                    : std::numeric_limits<double>::infinity();
}

}  // namespace sinew::gas
