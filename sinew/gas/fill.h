// gas/fill.h - time in which a valve fills or vents a rigid volume; for design, not for the loop.
//
//   t = integral of V d(rho)/m'(P)  from P_1 to P_2,   d(rho)/dP = rho/(n_p P)            [38]-[40]
//
// Closed forms where the flow is choked, G_c = A C_m / sqrt(T):
//
//   filling           m' = G_c P_supply      t = V (rho_2 - rho_1)/(G_c P_supply)
//   venting, n_p = 1  m' = G_c P             t = V/(G_c R T) log(P_1/P_2)
//
// Otherwise the integral is over s = log|P - P_port|, which makes the slow end at P_port harmless,
// in pieces that end at the kinks of the law (choking, linear part). Each piece uses Simpson's
// rule, doubled until it converges: deterministic, relative error below 1e-9 (tested).
//
// The polytrope is the law of a muscle whose air has an exponent. For a rigid volume the energy
// balance is the better law. Its two limits are walls that pass no heat and walls that keep the air
// at the room's temperature. Real walls are between these limits, or some percent slower than the
// slower one, since air that was warmed or cooled first continues to change its pressure.
//
// The valve's opening delay is not included; moving volumes and hoses take longer.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sinew/gas/air.h"
#include "sinew/gas/heat.h"
#include "sinew/gas/orifice.h"
#include "sinew/gas/valve.h"
#include "sinew/units/stages.h"

namespace sinew::gas {

// Returns the integral of f from a to b for a smooth f.
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

// Returns the time in which a chamber goes `from` one pressure `to` another while the open valve
// joins it to a port of constant pressure, all absolute [s]. `stored(P)` is the air stored per
// pressure and volume [kg/(Pa m^3)], relative to the flow of the law at the room's temperature.
// Returns infinity if the port cannot bring the chamber to `to`, which includes the port's own
// pressure: near it the flow is linear and the approach exponential.
template <class Stored>
double transfer_time_by(const Flow& flow, const Air& air, double volume, double port, double from,
                        double to, const Stored& stored) {
  if (from == to) return 0.0;
  const double side = to > from ? -1.0 : 1.0;  // sign of P - P_port
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
    return volume * stored(p) * distance / std::abs(mass_flow(flow, air, port, p));
  };
  double time = 0;
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    if (nodes[i] > nodes[i + 1]) {
      time += integral(slowness, units::log(nodes[i + 1]), units::log(nodes[i]));
    }
  }
  return time;
}

// Returns the time by the polytrope of `air`, [40] [s].
inline double transfer_time(const Flow& flow, const Air& air, double volume, double port,
                            double from, double to) {
  return transfer_time_by(flow, air, volume, port, from, to, [&](double p) {
    return density(air, p) / (air.polytropic_exponent * p);
  });
}

// Returns the time by the energy balance with walls that pass no heat [s]: air that enters brings
// c_p T_room, P' = gamma R T_room m'/V; air that stays expands along its adiabat, so the air that
// leaves is cold.
inline double adiabatic_transfer_time(const Flow& flow, const Air& air, double volume, double port,
                                      double from, double to) {
  constexpr double k = heat_capacity_ratio;
  const double room = 1.0 / (k * air.gas_constant * air.temperature);
  return transfer_time_by(flow, air, volume, port, from, to, [&](double p) {
    return to > from ? room : room * units::exp(-0.5 * (k - 1) / k * units::log(p / from));
  });
}

// Returns the time with walls that keep the air at the room's temperature  [s].
inline double isothermal_transfer_time(const Flow& flow, const Air& air, double volume, double port,
                                       double from, double to) {
  const double room = 1.0 / (air.gas_constant * air.temperature);
  return transfer_time_by(flow, air, volume, port, from, to, [&](double) { return room; });
}

// Air of a rigid chamber, per volume: its mass [kg/m^3] and its pressure [Pa].
struct WarmAir {
  double density = 0, pressure = 0;
};

// Returns the rates of the air in a rigid chamber joined to a port, with walls of the time constant
// air.wall_time (heat.h).
inline WarmAir warm_rates(const Flow& flow, const Air& air, double volume, double port,
                          const WarmAir& now) {
  constexpr double k = heat_capacity_ratio;
  const double room = air.temperature;
  const double t = now.pressure / (air.gas_constant * now.density);
  double in = mass_flow(flow, air, port, now.pressure) / volume;
  const double passes = in > 0 ? room : t;  // temperature of the air that passes the valve [K]
  if (in < 0) in *= std::sqrt(room / t);
  const double warmth = (now.density * air.gas_constant * room - now.pressure) / air.wall_time;
  return {in, k * air.gas_constant * passes * in + warmth};
}

// Returns the time with walls of the time constant air.wall_time, above 0 [s]. Uses RK4 with
// steps of at most a two-hundredth of the remaining way and a fiftieth of the walls' time; the last
// step ends at the pressure. Walls quicker than a ten-thousandth of the filling time count as
// isothermal.
inline double warm_transfer_time(const Flow& flow, const Air& air, double volume, double port,
                                 double from, double to) {
  const double slowest = isothermal_transfer_time(flow, air, volume, port, from, to);
  if (!(air.wall_time > 1e-4 * slowest) || !std::isfinite(slowest)) return slowest;
  WarmAir now{from / (air.gas_constant * air.temperature), from};
  const auto rates = [&](const WarmAir& x) { return warm_rates(flow, air, volume, port, x); };
  const auto along = [](const WarmAir& x, double h, const WarmAir& r) {
    return WarmAir{x.density + h * r.density, x.pressure + h * r.pressure};
  };
  const auto after = [&](const WarmAir& x, double h) {
    WarmAir r[4] = {rates(x)};
    for (int i = 1; i < 4; ++i) r[i] = rates(along(x, i < 3 ? 0.5 * h : h, r[i - 1]));
    const units::StageMean mean(h);
    return WarmAir{x.density + mean([&](int i) { return r[i].density; }),
                   x.pressure + mean([&](int i) { return r[i].pressure; })};
  };
  const double up = to > from ? 1.0 : -1.0;
  double time = 0;
  for (int step = 0; step < 4'000'000; ++step) {
    const double flows = air.gas_constant * air.temperature *
                         std::abs(mass_flow(flow, air, port, now.pressure)) / volume;
    double h = std::min(0.005 * std::abs(port - now.pressure) / flows, 0.02 * air.wall_time);
    WarmAir next = after(now, h);
    if (up * (next.pressure - to) >= 0) {
      double low = 0;
      for (int halving = 0; halving < 50; ++halving) {
        const double middle = 0.5 * (low + h);
        (up * (after(now, middle).pressure - to) >= 0 ? h : low) = middle;
      }
      return time + h;
    }
    now = next;
    time += h;
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace sinew::gas
