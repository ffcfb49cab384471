// air/cylinder.h - a double-acting air cylinder between trolley and body, 4.2.
//
//   V_up   = dead_volume[up]   + A_up x_c       A_up = pi (bore^2 - rod^2)/4
//   V_down = dead_volume[down] + A_down (x_stroke - x_c)      A_down = pi bore^2/4
//   F_cyl = (P_up - P_atm) A_up - (P_down - P_atm) A_down
//
//   x_c    travel upwards from the extended stop, 0 ... x_stroke [m]
//   F_cyl  of the air on the body, up > 0; the atmosphere's push on the rod is in it [N]
//
// Chambers are named after the direction in which they push the body; the rod is in `up`. Friction,
// end stops and weights are not included. Valid within 0 <= x_c <= x_stroke; the dead volumes leave
// room for stops that give way a little.
#pragma once

#include <array>
#include <numbers>

#include "sinew/gas/valve.h"

namespace sinew::air {

// The two chambers, by the direction in which they push the body.
enum Side : int { up = 0, down = 1 };

struct Cylinder {
  // regulator:     `down` is held at `pressure`, `up` is open to the room.
  // valves:        four valves; inlet and exhaust of a chamber may be open together.
  // single_acting: `up` has its two valves, `down` is open to the room.
  enum class Mode { regulator, valves, single_acting };

  Mode mode = Mode::valves;
  double bore = 0;                           // diameter of the piston [m]
  double rod_diameter = 0;                   // [m]
  double stroke = 0;                         // S [m]
  std::array<double, 2> dead_volume{};       // up, down; includes hoses, above 0 [m^3]
  double pressure = 0;                       // regulator: set pressure of `down`, absolute [Pa]
  std::array<double, 2> initial_pressure{};  // for chambers with valves; 0: the atmosphere [Pa]
  std::array<gas::Valve, 2> inlet, exhaust;  // valves: up, down
};

// Returns the area of the piston that faces the chamber [m^2].
constexpr double area(const Cylinder& c, Side side) {
  const double rod = side == up ? c.rod_diameter : 0.0;
  return 0.25 * std::numbers::pi * (c.bore * c.bore - rod * rod);
}

// Returns the volume of the air in a chamber [m^3].
constexpr double volume(const Cylinder& c, Side side, double travel) {
  return c.dead_volume[side] + area(c, side) * (side == up ? travel : c.stroke - travel);
}

// Returns dV/ds [m^2].
constexpr double volume_slope(const Cylinder& c, Side side) {
  return side == up ? area(c, up) : -area(c, down);
}

// Returns F_cyl [N] from absolute pressures.
constexpr double force(const Cylinder& c, double pressure_up, double pressure_down,
                       double atmosphere) {
  return (pressure_up - atmosphere) * area(c, up) - (pressure_down - atmosphere) * area(c, down);
}

}  // namespace sinew::air
