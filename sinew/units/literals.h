// units/literals.h - 3.15_in, 62.0_psi, 0.5_ms: quantities in code, as SI doubles.
//
//   using namespace sinew::units::literals;
//   double mount_length = 3.15_in;
//   double pressure = absolute(62.0_psi);   // _psi does not state gauge or absolute
#pragma once

#include "sinew/units/constants.h"

namespace sinew::units::literals {

// Return the quantity in SI: m, m2, m3, kg, N, Pa for a pressure difference, s, K for a temperature
// above absolute zero, rad.
constexpr double operator""_in(long double v) { return static_cast<double>(v) * inch; }
constexpr double operator""_ft(long double v) { return static_cast<double>(v) * foot; }
constexpr double operator""_mm(long double v) { return static_cast<double>(v) / 1000; }
constexpr double operator""_in2(long double v) { return static_cast<double>(v) * (inch * inch); }
constexpr double operator""_ft2(long double v) { return static_cast<double>(v) * (foot * foot); }
constexpr double operator""_in3(long double v) {
  return static_cast<double>(v) * (inch * inch * inch);
}
constexpr double operator""_lb(long double v) { return static_cast<double>(v) * pound_mass; }
constexpr double operator""_lbf(long double v) { return static_cast<double>(v) * pound_force; }
constexpr double operator""_psi(long double v) { return static_cast<double>(v) * psi; }
constexpr double operator""_ms(long double v) { return static_cast<double>(v) / 1000; }
constexpr double operator""_degR(long double v) { return static_cast<double>(v) * 5 / 9; }
constexpr double operator""_deg(long double v) {
  return static_cast<double>(v) * std::numbers::pi / 180;
}

}  // namespace sinew::units::literals
