// identify/motion/free_decay.h - simulated swing of a mass on a sealed muscle, for fits of whole
// trajectories.
//
//   M L'' = M g - F(L, L', P) - F_dry          [36], [37] with true stick
//   P (V(L) + V_ext)^n_p  constant             [40] with no flow
//
//   L  length of the muscle, grows downwards [m]      F  actuator/tension.h, c L' in it [N]
//   F_dry  at most coulomb_bound (actuator/loss.h) [N]
//
// The air was sealed in at `pressure` with the mass hanging at rest. The model is the test
// stand's world (world/stand.h): a step is divided where the speed is zero, so that the friction
// reverses between smooth pieces, the method keeps its fourth order, and the trajectory is a
// smooth function of the parameters. Output within a piece is a cubic through lengths and speeds.
// Valid inside the braid, 0 < L < b; for actuators in parallel, use one with its share of mass and
// volume.
#pragma once

#include <optional>
#include <span>

#include "sinew/actuator/actuator.h"

namespace sinew::identify {

// A mass that hangs on a sealed muscle.
struct Hanging {
  actuator::Actuator actuator;
  double mass = 0;                 // M [kg]
  double pressure = 0;             // at rest, absolute [Pa]
  double external_volume = 0;      // V_ext [m^3]
  double polytropic_exponent = 0;  // n_p [-]
  double atmosphere = 0;           // [Pa]
  double gravity = 0;              // g [m/s^2]
};

// Returns the length at which the mass hangs at `pressure` without friction [m]; empty if there is
// no such length between the ends.
std::optional<double> rest_length(const Hanging& h);

// Returns the frequency of small oscillations about `length` without losses [rad/s]; 0 if there are
// none.
double sealed_frequency(const Hanging& h, double length);

// Writes the lengths at ascending `times` [s] for a mass with `length` and `velocity` at the first.
// Returns false if the trajectory leaves the braid. `steps_per_period` bounds the step.
bool free_decay(const Hanging& h, double length, double velocity, std::span<const double> times,
                std::span<double> lengths, int steps_per_period = 36);

}  // namespace sinew::identify
