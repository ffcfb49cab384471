// air/failure.h - a simulated machine whose state is no number any more: when, and what of it.
//
// Worlds notice it at the node where it happens, stand still from there on and answer every reading
// with a fault, so that no run goes on from it.
#pragma once

namespace sinew::air {

struct Failure {
  // Names what was no number any more.
  enum class Of { nothing, air, cylinder, motion };

  Of of = Of::nothing;
  int muscle = 0;     // whose air: its number
  double length = 0;  // of that muscle there [m]
  double time = 0;    // of the node [s]

  explicit operator bool() const { return of != Of::nothing; }
};

// Beyond these no state of a machine is one  [Pa], [rad] or [m], [kg/m^3].
inline constexpr double most_pressure = 1e12, farthest = 1e6, most_density = 1e6;

// Each asks whether a number can be that quantity of a machine at all: [Pa], a density of the
// reference's [-], [m] or [rad].
constexpr bool is_pressure(double p) { return p > 0 && p < most_pressure; }
constexpr bool is_density(double sigma) { return sigma > 0 && sigma < most_density; }
constexpr bool is_place(double at) { return at < farthest && at > -farthest; }

}  // namespace sinew::air
