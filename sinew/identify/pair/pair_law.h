// identify/pair/pair_law.h - what holds back a sealed antagonistic pair that is moved.
//
//   F(t) = bias + gain G(t - delay)
//   G = k x + A (P_b - P_a) + c v + m a + D w
//
//   k  elastic stiffness               A  force per pressure, -dV/dL of a muscle
//   c  viscous loss                    m  mass that is moved
//   D  dry friction, w its share       a, b: the muscle whose pressure falls, rises with x
//
//   dry       w = sign v
//   bristle   w follows x with slope 1/d, kept within +-1: a spring of D/d that slips at D
//   fading    the same, and w forgets itself: dw/dt = v/d - w/T, within +-1
//
// Nothing that stands still tells how it is loaded: its friction may be anything within +-D, and a
// motion does not say what. `fading` has the best guess go to zero with time T; a slow steady slip
// v then has D v T/d, up to D. `bristle` is one element of Maxwell's slip model.
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
