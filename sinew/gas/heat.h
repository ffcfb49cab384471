// gas/heat.h - heat exchange between air and its walls: the internal energy U is a second state.
//
//   P = (gamma - 1) U/V            T = U/(m c_v)
//   U' = sum of m' c_p T_upstream - P V' + m c_v (T_wall - T)/tau
//
//   tau  time constant of a chamber of constant volume [s]     T_wall = air.temperature
//
// This law replaces the polytrope [40] and has two limits: tau -> 0 is isothermal, and tau ->
// infinity is the adiabat P rho^-1.4 of [39] while no air is exchanged. In addition it models
// filling (supply air at rest warms up to 1.4 T as it fills a vacuum) and the cooling of a sealed
// chamber. A single tau approximates a film that changes with flow and density; we estimate 0.1 to
// 1 s for tubes of a muscle's size (0.6 s with h = 10 W/(m2 K), 3 mm of radius, 5 bar). It should
// be fitted.
#pragma once

#include "sinew/gas/air.h"

namespace sinew::gas {

// Returns the heat that a kilogram takes per kelvin at constant volume  [J/(kg K)].
constexpr double heat_capacity_volume(const Air& air) {  // c_v [J/(kg K)]
  return air.gas_constant / (heat_capacity_ratio - 1.0);
}
// Returns the heat that a kilogram takes per kelvin at constant pressure  [J/(kg K)].
constexpr double heat_capacity_pressure(const Air& air) {  // c_p [J/(kg K)]
  return heat_capacity_ratio * heat_capacity_volume(air);
}

// Returns U at the temperature of the wall [J].
constexpr double energy_at_rest(const Air& air, double mass) {
  return mass * heat_capacity_volume(air) * air.temperature;
}

// Returns the temperature of air by its energy and mass  [K].
constexpr double temperature(const Air& air, double energy, double mass) {  // T [K]
  return energy / (mass * heat_capacity_volume(air));
}
// Returns the absolute pressure of air by its energy and volume  [Pa].
constexpr double pressure_of_energy(double energy, double volume) {  // P [Pa]
  return (heat_capacity_ratio - 1.0) * energy / volume;
}

// Returns the heat flow from the wall to the air [W].
constexpr double heat_flow(const Air& air, double energy, double mass) {
  return (energy_at_rest(air, mass) - energy) / air.wall_time;
}

}  // namespace sinew::gas
