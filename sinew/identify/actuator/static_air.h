// identify/actuator/static_air.h - volume of the air in a muscle whose force was measured.
//
// A force shows how the volume changes with the length, F = -Eff P_g dV/dL; the volume itself is
// the constant of this integral and is left open. It is known from a measurement at rest:
//
//   V(L) = kappa V_braid(L) + V_a     V(L_0) = V_0, measured, or pi D^2/4 L_0
//   kappa = V_0/V_braid(L_0), from 1 to 1.5       Eff -> Eff/kappa, areas -> kappa x areas
//
//   V_braid  of the braid that was fitted, with Eff = 1 where it is not free [m3]
//   kappa    share by which the braid is wider than its force shows: what is lost [-]
//   V_a      what is left of the difference, below 0 of a thick wall or an insert [m3]
//
// The force is the same with every kappa. A braid that is known keeps its own: kappa = 1.
#pragma once

#include <string>

#include "sinew/actuator/actuator.h"
#include "sinew/json/json.h"

namespace sinew::identify {

// Air in a muscle at its rest length, and between which values it is known [m3].
struct AirAtRest {
  double volume = 0, low = 0, high = 0;
  bool known = false;  // from its diameter or a measured volume; else from the force alone
  double kappa = 1;    // by which the braid was made wider
};

// Returns the volume of a cylinder [m3].
double cylinder_volume(double length, double diameter);

// Gives the actuator the volume V_0 at its rest length [m3], at the same forces. Returns kappa.
double give_volume(double rest_length, double volume, bool braid_is_known, actuator::Actuator& a);

// Returns what is known of the air of a muscle whose force alone was measured. Seven Festo muscles
// of 10 and 20 mm had between a sixth and 3.6 times the volume that their fitted braid has.
AirAtRest air_by_force(const actuator::Actuator& a, double rest_length);

// Returns volume_m3, whether it is known, and low_m3 and high_m3 where it is not.
Json to_json(const AirAtRest& air);

}  // namespace sinew::identify
