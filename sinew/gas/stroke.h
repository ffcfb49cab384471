// gas/stroke.h - time in which a valve moves a muscle: volume and pressure change together.
//
//   t = integral of dm/m'(P)                              as in fill.h
//
//   isothermal            dm = (V dP + P dV)/(R T)
//   adiabatic, filling    dm = (V dP + k P dV)/(k R T)    energy balance; air enters at T
//   adiabatic, venting    dm/m = dP/(k P) + dV/V          the air that stays follows its adiabat,
//                                                         its temperature falls with it
//
// Between the two limits of heat the pressure's part of the air differs by k = 1.4. The time also
// depends on the load: it decides whether the volume or the pressure changes first. The muscle
// moves last if it has to lift, and takes longest then, since air enters slowest at the higher and
// leaves slowest at the lower pressure. A rigid volume is the case V_1 = V_2, with the times of
// fill.h.
//
// The muscle follows its air without delay: mass, damping and the hose's resistance take longer.
#pragma once

#include <cmath>
#include <limits>

#include "sinew/gas/fill.h"

namespace sinew::gas {

// Start and end of a motion: absolute pressures [Pa], volumes of air [m3]. Filling raises both or
// leaves one as it is, venting lowers both.
struct Stroke {
  double from = 0, to = 0;
  double volume_from = 0, volume_to = 0;
};

// Names what changes first: the volume; both, along a straight line; or the pressure.
enum class Order { volume_first, together, pressure_first };

// Returns the time in which the volume changes at one pressure [s].
inline double isobaric_time(const Flow& flow, const Air& air, double port, double pressure,
                            double growth) {
  if (growth == 0) return 0.0;
  const double in = mass_flow(flow, air, port, pressure);
  return in * growth > 0 ? pressure * growth / (air.gas_constant * air.temperature * in)
                         : std::numeric_limits<double>::infinity();
}

// Returns the time in which pressure and volume change along a straight line [s].
inline double together_time(const Flow& flow, const Air& air, double port, const Stroke& s,
                            bool adiabatic) {
  constexpr double k = heat_capacity_ratio;
  const double room = air.gas_constant * air.temperature, growth = s.volume_to - s.volume_from;
  if (s.from == s.to) return isobaric_time(flow, air, port, s.from, growth);
  const double slope = growth / (s.to - s.from);
  return transfer_time_by(flow, air, 1.0, port, s.from, s.to, [&](double p) {
    const double volume = s.volume_from + slope * (p - s.from);
    if (!adiabatic) return (volume + p * slope) / room;
    if (s.to > s.from) return (volume / k + p * slope) / room;
    constexpr double power = 1.0 / k + 0.5 * (k - 1.0) / k;
    return s.from / room * units::exp(power * units::log(p / s.from)) * (volume / (k * p) + slope);
  });
}

// Returns the time of a motion with the open valve between the muscle and a port of constant
// pressure [s]: without heat from the walls, or at the room's temperature. Infinite if the port
// cannot bring the muscle there.
inline double stroke_time(const Flow& flow, const Air& air, double port, const Stroke& s,
                          bool adiabatic, Order order = Order::together) {
  const double growth = s.volume_to - s.volume_from;
  if (order == Order::together) return together_time(flow, air, port, s, adiabatic);
  if (order == Order::volume_first)
    return isobaric_time(flow, air, port, s.from, growth) +
           together_time(flow, air, port, {s.from, s.to, s.volume_to, s.volume_to}, adiabatic);

  // Air that has expanded is cold: it is denser by T_0/T, and leaves faster by the root only.
  constexpr double power = 0.5 * (heat_capacity_ratio - 1.0) / heat_capacity_ratio;
  const double cold =
      adiabatic && s.to < s.from ? units::exp(power * units::log(s.from / s.to)) : 1.0;
  return together_time(flow, air, port, {s.from, s.to, s.volume_from, s.volume_from}, adiabatic) +
         cold * isobaric_time(flow, air, port, s.to, growth);
}

}  // namespace sinew::gas
