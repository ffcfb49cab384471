// gas/supply.h - where the compressed air comes from.
//
// Constant: a regulator or a tank so large that its pressure does not move (3.4: 100 psi in the
// text, 98 in appendix A). Tank: a rigid volume that empties, behind a pressure regulator (4.2: 100
// gallons):
//
//   P_tank = m R T / V        line = min(set pressure, P_tank)
//
// The tank's walls keep its air at T: right where it empties in minutes, not in seconds. The
// regulator is ideal: no droop with flow. Air that flows back through an inlet goes back into it.
#pragma once

#include "sinew/gas/air.h"

namespace sinew::gas {

struct Supply {
  // Is the line's pressure constant, or that of a tank that empties?
  enum class Kind { constant, tank };
  Kind kind = Kind::constant;
  double pressure = 790828.661526411;  // of the line, absolute [Pa], 100 psi gauge
  double volume = 0;                   // tank: V [m^3]
  double initial_pressure = 0;         // tank: before the run, absolute [Pa]
};

// Air in the tank at a pressure  [kg].
constexpr double tank_mass(const Supply& supply, const Air& air, double pressure) {
  return pressure * supply.volume / (air.gas_constant * air.temperature);
}

// P_tank  [Pa].
constexpr double tank_pressure(const Supply& supply, const Air& air, double mass) {
  return mass * (air.gas_constant * air.temperature) / supply.volume;
}

// Behind the regulator  [Pa].
constexpr double line_pressure(const Supply& supply, double tank_pressure) {
  return tank_pressure < supply.pressure ? tank_pressure : supply.pressure;
}

}  // namespace sinew::gas
