// identify/actuator/static_air.h - volume of the air in a muscle identified from its force.
//
// The force shows how the volume changes with the length, F = -Eff P_g dV/dL. The volume itself is
// the constant of this integral and remains undetermined; it follows from a measurement at rest:
//
//   V(L) = kappa V_braid(L) + V_a     V(L_0) = V_0, measured, or pi D^2/4 L_0
//   kappa = V_0/V_braid(L_0), from 1 to 1.5       Eff -> Eff/kappa, areas -> kappa x areas
//
//   V_braid  volume of the fitted braid, with Eff = 1 where it is not free [m3]
//   kappa    ratio of the braid's volume to the one that its force shows: losses [-]
//   V_a      rest of the difference; negative for a thick wall or an insert [m3]
//
// The force does not depend on kappa. A braid that is given is not changed: kappa = 1.
#pragma once

#include "sinew/actuator/actuator.h"
#include "sinew/json/json.h"

namespace sinew::identify {

// Air in a muscle at its rest length, with lower and upper limits [m3].
struct AirAtRest {
  double volume = 0, low = 0, high = 0;
  bool known = false;  // from its diameter or a measured volume; false: from the force alone
  double kappa = 1;    // factor by which the braid's volume was enlarged
};

// Returns the volume of a cylinder [m3].
double cylinder_volume(double length, double diameter);

// Gives the actuator the volume V_0 [m3] at its rest length, with unchanged forces. Returns kappa.
double give_volume(double rest_length, double volume, bool braid_is_known, actuator::Actuator& a);

// Returns the air of a muscle as far as the force determines it. Seven Festo muscles of 10 and 20
// mm had between a sixth and 3.6 times the volume of their fitted braid.
AirAtRest air_by_force(const actuator::Actuator& a, double rest_length);

// Returns volume_m3, known, and if it is not known low_m3 and high_m3.
Json to_json(const AirAtRest& air);

}  // namespace sinew::identify
