// identify/pair/pair_law.h - what holds back a sealed antagonistic pair that is moved.
//
//   Phi(t) = bias + gain Phi_m(t - delay)
//   Phi_m = k x + A (P_b - P_a) + c x' + M x'' + Phi_c phi
//
//   k      elastic stiffness             A  effort per pressure, -dV/dL of a muscle
//   c      viscous loss                  M  mass that is moved
//   Phi_c  dry friction, phi its share   a, b: the muscle whose pressure falls, rises with x
//
//   dry       phi = sign x'
//   bristle   phi follows x with slope 1/x_slip, kept within +-1: a spring of Phi_c/x_slip that
//             slips at Phi_c
//   fading    the same, and phi decays: phi' = x'/x_slip - phi/t_fade, within +-1
//
// The load of a pair at rest is unknown: its friction may be anything within +-Phi_c, and the
// motion does not determine it. `fading` lets the best guess go to zero with the time t_fade; a
// slow steady slip then has Phi_c x' t_fade/x_slip, up to Phi_c. `bristle` is one element of
// Maxwell's slip model.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/identify/fit/least_squares.h"
#include "sinew/identify/pair/pair_record.h"

namespace sinew::identify {

// How dry friction acts: not at all; by the sign of the rate; over a way of presliding; so, and
// forgotten at rest.
enum class PairFriction { none, dry, bristle, fading };

// Which terms a law has.
struct PairLaw {
  const char* name;
  const char* law;
  const char* source;
  bool spring = false, air = false, viscous = false, mass = false;
  PairFriction friction = PairFriction::none;
};

// All that are tried, in ascending order of their terms.
std::span<const PairLaw> pair_laws();

// Physics that all recordings share; for a joint: N m/rad, m3, N m s/rad, kg m2, N m, rad.
struct PairValues {
  double stiffness = 0;   // k [N/m]
  double area = 0;        // A [m2]
  double viscous = 0;     // c [N s/m]
  double mass = 0;        // m [kg]
  double friction = 0;    // D [N]
  double presliding = 0;  // d [m], > 0 where the law has it
  double fade_time = 0;   // T [s], > 0 where the law has it
};

// What a recording and the sensors of its rig add.
struct PairSensors {
  double bias = 0;   // of the effort [N]
  double gain = 1;   // of the effort
  double delay = 0;  // of the effort behind the position [s]
  double start = 0;  // w at the first sample
};

// How the pressures of a recording pull: their difference, b - a, less its mean  [Pa]. Of one
// measured pressure twice it, as if the other muscle were its mirror. Empty: none was measured.
std::vector<double> pair_pressure(const PairRecord& record);

// Writes G(t - delay) at each sample, the effort before bias and gain; `start` is w at the first.
// `pressure` is pair_pressure().
void pair_effort(const PairLaw& law, const PairValues& values, double start, double delay,
                 const PairRecord& record, std::span<const double> pressure, std::span<double> out);

// Writes the share w of dry friction at each sample.
void pair_friction(const PairLaw& law, const PairValues& values, double start,
                   const PairRecord& record, std::span<double> out);

}  // namespace sinew::identify
