// muscle/cylinder.h - a double-acting air cylinder that lifts the body, 4.2.
//
//   V_up   = dead_volume_up   + A_up s          A_up, A_down  pi bore^2/4, less the rod's area
//   V_down = dead_volume_down + A_down (S - s)                on the side where the rod is
//   F = (P_up - P_atm) A_up - (P_down - P_atm) A_down
//
//   s  travel: how far the `up` chamber has grown, 0 ... S, the stroke [m]
//   F  of the air on the body, up > 0; the atmosphere's push on the rod is in it [N]
//
// Chambers are named after the way in which they push the body. Friction, end stops and the body's
// weight are not in here. Valid within 0 <= s <= S; a stop that gives way a little needs a dead
// volume.
#pragma once

#include <array>
#include <numbers>

#include "sinew/gas/valve.h"

namespace sinew::muscle {

struct Cylinder {
  // regulator: the up chamber is held at `pressure`, the down chamber is open.
  // valves:    four valves; inlet and exhaust of a chamber may be open together.
  enum class Mode { regulator, valves };
  enum class Rod { in_down_chamber, in_up_chamber };

  Mode mode = Mode::valves;
  double bore = 0;          // diameter of the piston [m]
  double rod_diameter = 0;  // [m]
  Rod rod = Rod::in_down_chamber;
  double stroke = 0;                    // S [m]
  double dead_volume_up = 0;            // left in the chamber and its hoses at s = 0 [m^3]
  double dead_volume_down = 0;          // at s = S [m^3]
  double pressure = 101352.9322095749;  // regulator: what it holds; valves: where the up chamber
                                        // starts, the down chamber at the atmosphere's [Pa abs]
  std::array<gas::Valve, 2> inlet, exhaust;  // up, down
};

enum Side : int { up = 0, down = 1 };

// Of the piston, facing the chamber  [m^2].
constexpr double area(const Cylinder& c, Side side) {
  const bool with_rod = (side == down) == (c.rod == Cylinder::Rod::in_down_chamber);
  const double rod = with_rod ? c.rod_diameter : 0.0;
  return 0.25 * std::numbers::pi * (c.bore * c.bore - rod * rod);
}

// Of the air in a chamber  [m^3].
constexpr double volume(const Cylinder& c, Side side, double travel) {
  return side == up ? c.dead_volume_up + area(c, up) * travel
                    : c.dead_volume_down + area(c, down) * (c.stroke - travel);
}

// dV/ds  [m^2].
constexpr double volume_slope(const Cylinder& c, Side side) {
  return side == up ? area(c, up) : -area(c, down);
}

// F  [N], from absolute pressures.
constexpr double force(const Cylinder& c, double pressure_up, double pressure_down,
                       double atmosphere) {
  return (pressure_up - atmosphere) * area(c, up) - (pressure_down - atmosphere) * area(c, down);
}

}  // namespace sinew::muscle
