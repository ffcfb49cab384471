// gas/supply.h - source of the compressed air.
//
// Constant: a regulator or a tank so large that its pressure does not change (3.4: 100 psi in the
// text, 98 in appendix A). Tank: a rigid volume that empties, behind a pressure regulator (4.2: 100
// gallons):
//
//   P_tank = m R T / V        line = min(set pressure, P_tank)
//
// The tank's walls keep its air at T, which holds if it empties in minutes, not in seconds. The
// regulator is ideal: no droop with flow. Air that flows back through an inlet returns to the tank.
#pragma once

#include "sinew/gas/air.h"

namespace sinew::gas {

struct Supply {
  // Names the source: a line of constant pressure, or a tank that empties.
  enum class Kind { constant, tank };
  Kind kind = Kind::constant;
  double pressure = 790828.661526411;  // absolute pressure of the line [Pa], 100 psi gauge
  double volume = 0;                   // tank: V [m^3]
  double initial_pressure = 0;         // tank: before the run, absolute [Pa]
};

// Returns the mass of air in the tank at a pressure [kg].
constexpr double tank_mass(const Supply& supply, const Air& air, double pressure) {
  return pressure * supply.volume / (air.gas_constant * air.temperature);
}

// Returns P_tank [Pa].
constexpr double tank_pressure(const Supply& supply, const Air& air, double mass) {
  return mass * (air.gas_constant * air.temperature) / supply.volume;
}

// Returns the pressure behind the regulator [Pa].
constexpr double line_pressure(const Supply& supply, double tank_pressure) {
  return tank_pressure < supply.pressure ? tank_pressure : supply.pressure;
}

}  // namespace sinew::gas
