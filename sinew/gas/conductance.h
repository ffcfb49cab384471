// gas/conductance.h - flow of a valve as makers publish it, converted to C and b of ISO 6358-1.
//
//   C, b   sonic conductance [m3/(s Pa)] and critical pressure ratio [-], ISO 6358-1: the only pair
//          that gives the flow at every pressure
//   Q_n    nominal flow of reference air (ANR) at 20 degC, 6 bar gauge before and 5 bar gauge
//          behind the valve [m3/s]
//              Q_n = C P_6 sqrt(1 - ((r - b)/(1 - b))^2),   r = P_5/P_6 = 0.857
//   C_v    water in US gal/min at 1 psi; of air, by NFPA T3.21.3,
//              Q = 22.48 C_v sqrt((P_1 - P_2) P_2/T)   scfm at 68 degF and 14.7 psi; psi, degR
//          taken at 6 and 5 bar gauge: Q_n = 999 L/min x C_v
//   K_v    water in m3/h at 1 bar: K_v = 0.865 C_v
//   A      effective area, see orifice.h: the same choked flow, for a hole of b = 0.528
//
// Q_n, C_v and K_v are one number, measured or calculated at one pair of pressures. C follows only
// with b, which has to be known or assumed: b from 0.2 to 0.5 changes C by a fifth. C_v and K_v are
// defined with water; the step to air is a convention, and those of other standards differ by some
// percent.
#pragma once

#include <cmath>

#include "sinew/gas/orifice.h"
#include "sinew/units/constants.h"

namespace sinew::gas {

// Pressures of a nominal flow, 6 and 5 bar above the standard atmosphere [Pa].
inline constexpr double nominal_upstream = 6e5 + units::atmosphere;
inline constexpr double nominal_downstream = 5e5 + units::atmosphere;

// Returns Q_n per C [Pa]: 4.24e5 for b = 0.3.
inline double nominal_flow_per_conductance(double critical_ratio) {
  return mass_flow_iso6358(1.0, critical_ratio, nominal_upstream, iso_temperature,
                           nominal_downstream) /
         iso_density;
}

// Convert between C and Q_n of a valve with this b.
inline double nominal_flow_of(double sonic_conductance, double critical_ratio) {
  return sonic_conductance * nominal_flow_per_conductance(critical_ratio);  // [m3/s]
}
inline double conductance_of_nominal_flow(double nominal_flow, double critical_ratio) {
  return nominal_flow / nominal_flow_per_conductance(critical_ratio);  // [m3/(s Pa)]
}

// Returns Q_n per C_v [m3/s], from scfm at 14.696 psi to reference air at 1 bar.
inline double nominal_flow_per_cv() {
  constexpr double cubic_foot_per_minute = units::foot * units::foot * units::foot / 60.0;
  constexpr double difference = (nominal_upstream - nominal_downstream) / units::psi;
  constexpr double behind = nominal_downstream / units::psi;
  constexpr double rankine = 1.8 * iso_temperature;
  return 22.48 * cubic_foot_per_minute * std::sqrt(difference * behind / rankine) *
         (units::atmosphere / units::bar);
}

// Convert between C_v [-] and Q_n [m3/s].
inline double nominal_flow_of_cv(double cv) { return cv * nominal_flow_per_cv(); }
inline double cv_of_nominal_flow(double nominal_flow) {
  return nominal_flow / nominal_flow_per_cv();
}

// Returns K_v per C_v, exactly: gal/min in m3/h, over the root of 1 psi in bar.
inline double kv_per_cv() {
  constexpr double gallon = 231 * units::inch * units::inch * units::inch;
  return gallon * 60.0 * std::sqrt(units::bar / units::psi);
}

}  // namespace sinew::gas
