// gas/storage.h - stores of compressed air: mass and exergy of a bottle, what it yields down to a
// regulator's pressure, the flow of a compressor, a regulator's droop; for design, not for the
// loop.
//
//   m = P V/(Z R T)                     Z(P) from a table
//   B = m [R T I(P) - (P - P_atm) v]    exergy of a closed store at the room's temperature;
//                                       v = V/m,  I = integral of Z dP/P from P_atm to P
//   b_s = R T I(P)                      exergy of a kilogram that flows in a line, as dB = b_s dm
//
// Emptying from P_1 to P_2, the set pressure of the regulator, has two limits:
//
//   walls that keep the air at T        m_2 = P_2 V/(Z_2 R T)                T_2 = T
//   walls that pass no heat             m_2 = m_1 (P_2/P_1)^(1/gamma)        T_2 = T
//   (P_2/P_1)^((gamma-1)/gamma)
//
// The second leaves more air behind, since the air that stays is cold and dense. A robot that
// empties its bottle in minutes is between them, nearer the first; heat.h has the law between. The
// second is no prediction: metal walls warm the air long before it is that cold. It is about a
// bound, not exactly: the exponent is that of an ideal gas. By the equation of state of Peng and
// Robinson (1976) a store at 20 to 310 bar yields 1 to 3 % less down to 8 bar, and at 200 bar 7 %
// less down to 30 bar.
//
//   B   exergy [J]: the greatest work that the room allows        b_s  the same per mass [J/kg]
//   Z   compressibility [-]: Vasserman, Kazavchinskii and Rabinovich (1966) at 300 K, as in Perry's
//       handbook, 6th edition (1984), linear between its rows. Room temperatures of 280 to 310 K
//       differ by less than 2 % at 300 bar. Without it an ideal gas has 3 % too much air at
//       200 bar and 11 % at 300 bar.
//   R, T, P_atm, gamma as in air.h
//
// Valid up to 320 bar, a bottle of 4500 psi; all are NaN beyond. There the second limit, which has
// the exponent of an ideal gas, would leave less air than warm walls do.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "sinew/gas/air.h"

namespace sinew::gas {

inline constexpr double highest_stored_pressure = 320e5;  // absolute [Pa]

// Row of the table of Z.
struct Compressibility {
  double pressure = 0;  // absolute [Pa]
  double z = 1;         // [-]
};

inline constexpr std::array<Compressibility, 14> compressibility_at_300_k{{{0, 1},
                                                                           {1e5, 0.9999},
                                                                           {5e5, 0.9987},
                                                                           {10e5, 0.9974},
                                                                           {20e5, 0.9950},
                                                                           {40e5, 0.9917},
                                                                           {60e5, 0.9901},
                                                                           {80e5, 0.9903},
                                                                           {100e5, 0.9930},
                                                                           {150e5, 1.0074},
                                                                           {200e5, 1.0326},
                                                                           {250e5, 1.0669},
                                                                           {300e5, 1.1089},
                                                                           {400e5, 1.2073}}};

// Returns Z at an absolute pressure [-].
constexpr double compressibility(double pressure) {
  if (!(pressure >= 0 && pressure <= highest_stored_pressure))
    return std::numeric_limits<double>::quiet_NaN();
  const auto& table = compressibility_at_300_k;
  std::size_t i = 1;
  while (table[i].pressure < pressure) ++i;
  const auto& [p0, z0] = table[i - 1];
  const auto& [p1, z1] = table[i];
  return z0 + (z1 - z0) * (pressure - p0) / (p1 - p0);
}

// Returns I, the integral of Z dP/P between two absolute pressures above 0 [-]: exact for the
// table, (z_0 - slope P_0) log(P_b/P_a) + slope (P_b - P_a) in each of its pieces.
inline double compressibility_integral(double from, double to) {
  if (to < from) return -compressibility_integral(to, from);
  double sum = 0;
  for (std::size_t i = 1; i < compressibility_at_300_k.size(); ++i) {
    const auto& [p0, z0] = compressibility_at_300_k[i - 1];
    const auto& [p1, z1] = compressibility_at_300_k[i];
    const double a = std::max(from, p0), b = std::min(to, p1);
    if (!(b > a)) continue;
    const double slope = (z1 - z0) / (p1 - p0);
    sum += (z0 - slope * p0) * std::log(b / a) + slope * (b - a);
  }
  return std::isnan(compressibility(to)) ? std::numeric_limits<double>::quiet_NaN() : sum;
}

// Returns the mass of the air in a store at the room's temperature [kg]; `pressure` is absolute.
inline double stored_mass(const Air& air, double volume, double pressure) {
  return pressure * volume / (compressibility(pressure) * air.gas_constant * air.temperature);
}

// Returns B, the exergy of a store at the room's temperature [J].
inline double stored_exergy(const Air& air, double volume, double pressure) {
  const double mass = stored_mass(air, volume, pressure);
  return mass * air.gas_constant * air.temperature *
             compressibility_integral(air.atmosphere, pressure) -
         (pressure - air.atmosphere) * volume;
}

// Returns b_s, the exergy of a kilogram of air that flows in a line of an absolute pressure [J/kg].
inline double stream_exergy(const Air& air, double pressure) {
  return air.gas_constant * air.temperature * compressibility_integral(air.atmosphere, pressure);
}

// Air that stays in a store after it was emptied to a pressure.
struct AirLeft {
  double mass = 0;         // [kg]
  double temperature = 0;  // [K]
};

// Returns the air left behind walls that keep it at the room's temperature.
inline AirLeft left_at_room_temperature(const Air& air, double volume, double to) {
  return {stored_mass(air, volume, to), air.temperature};
}

// Returns the air left behind walls that pass no heat; `to` is at most `from`, and both are
// absolute.
inline AirLeft left_without_heat(const Air& air, double volume, double from, double to) {
  const double ratio = std::log(to / from), k = heat_capacity_ratio;
  return {stored_mass(air, volume, from) * std::exp(ratio / k),
          air.temperature * std::exp(ratio * (k - 1) / k)};
}

// Point of a compressor's published table. Free flow is the volume that it takes in from the room
// per time.
struct CompressorPoint {
  double gauge_pressure = 0;  // in its outlet [Pa]
  double free_flow = 0;       // [m3/s]
  double power = 0;           // electrical [W]; 0: not known
};

// Returns the compressor at a gauge pressure, linear between the points, which are in ascending
// order of pressure. Below the first point it is that of the first. Above the last one it delivers
// nothing, since it is unknown there.
inline CompressorPoint compressor_at(std::span<const CompressorPoint> points,
                                     double gauge_pressure) {
  if (points.empty() || gauge_pressure > points.back().gauge_pressure) return {gauge_pressure};
  std::size_t i = 0;
  while (points[i].gauge_pressure < gauge_pressure) ++i;
  if (i == 0) return {gauge_pressure, points[0].free_flow, points[0].power};
  const CompressorPoint &a = points[i - 1], &b = points[i];
  const double share = (gauge_pressure - a.gauge_pressure) / (b.gauge_pressure - a.gauge_pressure);
  return {gauge_pressure, a.free_flow + share * (b.free_flow - a.free_flow),
          a.power + share * (b.power - a.power)};
}

// Returns the mass flow of free air [kg/s].
constexpr double mass_of_free_air(const Air& air, double free_flow) {
  return free_flow * density_at_atmosphere(air);
}

// Returns the pressure in a line behind a regulator whose pressure falls in proportion to the flow
// [Pa]; `droop` is the fall per free flow [Pa s/m3].
constexpr double drooped_pressure(double set_pressure, double droop, double free_flow) {
  return set_pressure - droop * free_flow;
}

}  // namespace sinew::gas
