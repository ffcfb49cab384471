// units/constants.h - the defined constants of measurement, as SI doubles.
#pragma once

#include <numbers>

namespace sinew::units {

inline constexpr double inch = 0.0254;                    // [m]
inline constexpr double foot = 0.3048;                    // [m]
inline constexpr double pound_mass = 0.45359237;          // [kg]
inline constexpr double standard_gravity = 9.80665;       // [m/s2]
inline constexpr double pound_force = 4.4482216152605;    // [N], pound_mass x standard_gravity
inline constexpr double slug = pound_force / foot;        // [kg], lbf s2/ft
inline constexpr double psi = 6894.757293168361;          // [Pa], lbf/in2
inline constexpr double bar = 1e5;                        // [Pa]
inline constexpr double rankine = 5.0 / 9.0;              // [K]
inline constexpr double celsius_zero = 273.15;            // [K]
inline constexpr double degree = std::numbers::pi / 180;  // [rad]

inline constexpr double atmosphere_psi = 14.7;              // [psi], the thesis's round value
inline constexpr double atmosphere = atmosphere_psi * psi;  // [Pa]

// Convert between gauge pressures, which are relative to the atmosphere, and absolute
// pressures, which are used everywhere inside Sinew.
constexpr double absolute(double gauge_pressure, double atmospheric = atmosphere) {
  return gauge_pressure + atmospheric;
}
constexpr double gauge(double absolute_pressure, double atmospheric = atmosphere) {
  return absolute_pressure - atmospheric;
}

}  // namespace sinew::units
