// gas/air.h - air in a chamber: its mass is the state, [38]-[40].
//
// [40] makes P (V/m)^n_p constant, so with the atmosphere as the reference
//
//   P = P_atm (rho / rho_atm)^n_p,   rho = m / V,   rho_atm = P_atm / (R T)
//
// n_p = 1.4 is the adiabatic exponent of [39], n_p = 1 isothermal air; any value between may be
// fitted.
#pragma once

#include "sinew/units/math.h"

namespace sinew::gas {

inline constexpr double heat_capacity_ratio = 1.4;  // gamma of air, [39]; the orifice needs it [-]

struct Air {
  double atmosphere = 101352.9322095749;    // P_atm [Pa], 14.7 psi
  double temperature = 293.33333333333333;  // air upstream of an orifice and at rest [K]
  double polytropic_exponent = 1.4;         // n [-]
  double gas_constant = 286.98629312304;    // R [J/(kg K)], 53.34 ft lbf/(lb degR)
  double wall_time = 0;  // time constant of the walls' heat exchange, heat.h; 0: polytrope [s]
};

// Returns the density of the reference state (P_atm, T) [kg/m^3].
constexpr double density_at_atmosphere(const Air& air) {
  return air.atmosphere / (air.gas_constant * air.temperature);
}

// Returns P(rho) [Pa].
constexpr double pressure(const Air& air, double density) {
  return air.atmosphere *
         units::power(density / density_at_atmosphere(air), air.polytropic_exponent);
}

// Returns rho(P), the inverse [kg/m^3].
constexpr double density(const Air& air, double absolute_pressure) {
  return density_at_atmosphere(air) *
         units::power(absolute_pressure / air.atmosphere, 1.0 / air.polytropic_exponent);
}

}  // namespace sinew::gas
