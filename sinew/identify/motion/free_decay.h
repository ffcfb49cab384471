// identify/motion/free_decay.h - how a mass on a sealed muscle swings: what a fit of the whole
// trajectory compares with.
//
//   M L'' = M g - F(L, L', P) - F_dry          [36], [37] with true stick
//   P (V(L) + V_ext)^n_p  constant             [40] with no flow
//
//   L  length of the muscle, grows downwards [m]      F  actuator/tension.h, c L' in it [N]
//   F_dry  at most coulomb_bound (actuator/loss.h) [N]
//
// The air was shut in at `pressure` where the mass hung at rest. It is the test stand's world
// (world/stand.h): a step is cut where the speed is zero, so that the friction changes sides
// between smooth pieces, the error keeps its fourth order, and the trajectory is smooth in its
// parameters. Within a piece a cubic through lengths and speeds. Valid inside the braid, 0 < L < b;
// of actuators in parallel one, with its share of mass and volume.
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

// Where the mass hangs at `pressure` without friction  [m]; none: nowhere between the ends.
std::optional<double> rest_length(const Hanging& h);

// Small oscillations about `length`, without losses  [rad/s]; 0 where there are none.
double sealed_frequency(const Hanging& h, double length);

// Lengths at `times` [s], which ascend, of a mass that has `length` and `velocity` at the first.
// False where the trajectory leaves the braid. `steps_per_period` bounds the step.
bool free_decay(const Hanging& h, double length, double velocity, std::span<const double> times,
                std::span<double> lengths, int steps_per_period = 36);

}  // namespace sinew::identify
