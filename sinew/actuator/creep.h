// actuator/creep.h - tension that goes on growing after the pressure has come to rest.
//
//   F = F(L, v, P_e) + sum chi_i (F(L, 0, P_late) - F(L, 0, 0))      P_late' = (P_e - P_late)/t_i
//
//   P_e    effective gauge pressure of the mesh [Pa]      P_late  the same, late [Pa], a state
//   chi_i  share of the tension that comes late [-]       t_i     its time constant [s]
//
// At one pressure and length F grows to F (1 + sum chi_i); where Eff is constant, exactly as
// F (1 + sum chi_i (1 - exp(-t/t_i))) from a step of the pressure on. It is the pressure that comes
// late, not the tension: a muscle whose stretch came late would give back more than was put in.
// At one pressure, at rest, the tension is a function of length alone and loops of length are
// closed.
//
// Not in the thesis. Bounded by the pressures that were; stable in steps up to 2.5 t_i.
#pragma once

#include "sinew/actuator/actuator.h"
#include "sinew/actuator/tension.h"

namespace sinew::actuator {

// Is there any creep to be integrated?
constexpr bool has_creep(const Creep& creep) {
  for (const double share : creep.share)
    if (share != 0) return true;
  return false;
}

// P_late'  [Pa/s].
constexpr double creep_rate(double time, double gauge_pressure, double late) {
  return (gauge_pressure - late) / time;
}

// What one element adds  [N].
inline double creep_tension(const Actuator& a, double share, double length, double late,
                            double atmosphere) {
  return share * (clamped_tension(a, length, 0.0, late, atmosphere) -
                  clamped_tension(a, length, 0.0, 0.0, atmosphere));
}

}  // namespace sinew::actuator
