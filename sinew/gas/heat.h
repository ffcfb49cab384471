// gas/heat.h - air that exchanges heat with its walls: its internal energy U is a second state.
//
//   P = (gamma - 1) U/V            T = U/(m c_v)
//   U' = sum of m' c_p T_upstream - P V' + m c_v (T_wall - T)/tau
//
//   tau  time constant of a chamber of constant volume [s]     T_wall = air.temperature
//
// It takes the place of the polytrope [40], which it brackets: tau -> 0 is isothermal, tau ->
// infinity the adiabat P rho^-1.4 of [39] while no air is exchanged. What it adds is filling
// (supply air at rest warms up to 1.4 T as it fills a vacuum) and a sealed chamber that cools. One
// tau stands for a film that changes with flow and density: our estimate 0.1 to 1 s for tubes of a
// muscle's size (0.6 s with h = 10 W/(m2 K), 3 mm of radius, 5 bar); to be fitted.
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

// U at the temperature of the wall  [J].
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

// From the wall  [W].
constexpr double heat_flow(const Air& air, double energy, double mass) {
  return (energy_at_rest(air, mass) - energy) / air.wall_time;
}

}  // namespace sinew::gas
