// air/failure.h - failure of a simulated machine: the part whose state is not finite, and the time.
//
// A world detects it at the node where it happens, stops there and reports a fault for every
// reading, so that no run continues with invalid values.
#pragma once

namespace sinew::air {

struct Failure {
  // Names the part whose state is not finite.
  enum class Of { nothing, air, cylinder, motion };

  Of of = Of::nothing;
  int muscle = 0;     // index of the muscle whose air it is
  double length = 0;  // length of that muscle at the failure [m]
  double time = 0;    // time of the node [s]

  explicit operator bool() const { return of != Of::nothing; }
};

// Limits of a valid state [Pa], [rad] or [m], [kg/m^3].
inline constexpr double most_pressure = 1e12, largest_position = 1e6, most_density = 1e6;

// Return whether a number is possible as a pressure [Pa], as a density relative to the reference
// [-], and as a position [m] or [rad] of a machine, or of each in a pack. NaN is not.
constexpr bool is_pressure(double p) { return p > 0 && p < most_pressure; }
constexpr bool is_density(double sigma) { return sigma > 0 && sigma < most_density; }
template <class S>
constexpr auto is_position(const S& at) {
  return (at < largest_position) & (at > -largest_position);
}

}  // namespace sinew::air
