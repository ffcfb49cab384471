// gas/leak.h - leak of a chamber to the room: through a hole, and through a porous wall or a seal.
//
//   m' = orifice(area, P, P_atm) + G_l (P - P_atm)
//
// The first part, choked and isothermal, empties a rigid chamber by P = P_1 exp(-t G_c R T/V), m' =
// G_c P; the second lowers P - P_atm by exp(-t G_l R T/V). In 6.4 three bladders burst in 200
// steps; the leaks before that were not measured.
#pragma once

#include "sinew/gas/orifice.h"

namespace sinew::gas {

struct Leak {
  double area = 0;         // effective area of a hole [m^2]
  double conductance = 0;  // G [kg/(s Pa)]
};

// Constants of a leak for one air: the hole's flow, and the slope of the wall's.
struct LeakConstants {
  FlowConstants hole;
  double slope = 0;  // flow per P/P_atm [kg/s]

  // Returns whether there is no leak.
  bool tight() const { return hole.gain == 0 && slope == 0; }
};

// Returns the leak's constants for this air.
inline LeakConstants leak_constants(const Leak& leak, const Air& air) {
  return {flow_constants({.area = leak.area}, air), leak.conductance * air.atmosphere};
}

// Returns the flow from a chamber at y to the room [kg/s]; negative below the atmosphere.
inline double leak_flow_y(const LeakConstants& c, double y) {
  const double y3 = y * y * y;
  return flow_y(c.hole, y, 1.0) + c.slope * (y3 * y3 * y - 1.0);
}

// Returns the flow past a valve's seat from a chamber at y_a to one at y_b [kg/s], else negative.
inline double leak_flow_y(const LeakConstants& c, double y_a, double y_b) {
  const double a3 = y_a * y_a * y_a, b3 = y_b * y_b * y_b;
  return flow_y(c.hole, y_a, y_b) + c.slope * (a3 * a3 * y_a - b3 * b3 * y_b);
}

}  // namespace sinew::gas
