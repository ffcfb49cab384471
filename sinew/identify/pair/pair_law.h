// identify/pair/pair_law.h - forces that resist the motion of a sealed antagonistic pair.
//
//   Phi(t) = bias + gain Phi_m(t - delay)
//   Phi_m = k x + A (P_b - P_a) + c x' + M x'' + Phi_c phi
//
//   k      elastic stiffness             A  effort per pressure, -dV/dL of a muscle
//   c      viscous loss                  M  mass that is moved
//   Phi_c  dry friction, phi its share   a, b: the muscle whose pressure falls, rises with x
//
//   dry       phi = sign x'
//   bristle   phi follows x with slope 1/x_slip, limited to +-1: a spring of Phi_c/x_slip that
//             slips at Phi_c
//   fading    as bristle, and phi decays: phi' = x'/x_slip - phi/t_fade, limited to +-1
//
// The friction of a pair at rest is unknown: it may be anything within +-Phi_c, and the motion does
// not determine it. With `fading` its estimate decays to zero with the time t_fade; a slow steady
// slip then has Phi_c x' t_fade/x_slip, up to Phi_c. `bristle` is one element of Maxwell's slip
// model.
#pragma once

#include <span>
#include <vector>

#include "sinew/identify/contest/least_squares.h"
#include "sinew/identify/pair/pair_record.h"

namespace sinew::identify {

// Model of dry friction: none; by the sign of the rate; with presliding; with presliding and decay
// at rest.
enum class PairFriction { none, dry, bristle, fading };

// Terms of a law.
struct PairLaw {
  const char* name;
  const char* law;
  const char* source;
  bool spring = false, air = false, viscous = false, mass = false;
  PairFriction friction = PairFriction::none;
};

// Returns all laws, in ascending order of their terms.
std::span<const PairLaw> pair_laws();

// Physical values common to all recordings. Units for a joint: N m/rad, m3, N m s/rad, kg m2, N m,
// rad.
struct PairValues {
  double stiffness = 0;   // k [N/m]
  double area = 0;        // A [m2]
  double viscous = 0;     // c [N s/m]
  double mass = 0;        // M [kg]
  double friction = 0;    // Phi_c [N]
  double presliding = 0;  // x_slip [m], > 0 if the law has it
  double fade_time = 0;   // t_fade [s], > 0 if the law has it
};

// Parameters of a recording and of the sensors of its rig.
struct PairSensors {
  double bias = 0;   // bias of the effort [N]
  double gain = 1;   // gain of the effort
  double delay = 0;  // delay of the effort behind the position [s]
  double start = 0;  // phi at the first sample
};

// Returns the difference of the pressures, b - a, without its mean [Pa]. For a single measured
// pressure it is twice that pressure, as if the other muscle mirrored it. Empty: no pressure was
// measured.
std::vector<double> pair_pressure(const PairRecord& record);

// Writes Phi_m(t - delay) at each sample, the effort before bias and gain. `start` is phi at the
// first sample, `pressure` is pair_pressure().
void pair_effort(const PairLaw& law, const PairValues& values, double start, double delay,
                 const PairRecord& record, std::span<const double> pressure, std::span<double> out);

// Writes phi, the share of dry friction, at each sample.
void pair_friction(const PairLaw& law, const PairValues& values, double start,
                   const PairRecord& record, std::span<double> out);

}  // namespace sinew::identify
