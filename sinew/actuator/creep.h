// actuator/creep.h - tension that continues to grow after the pressure has settled.
//
//   F = F(L, v, P_e) + sum chi_i (F(L, 0, P_late) - F(L, 0, 0))      P_late' = (P_e - P_late)/t_i
//
//   P_e    effective gauge pressure of the mesh [Pa]      P_late  the same, delayed [Pa], a state
//   chi_i  share of the tension that is delayed [-]       t_i     its time constant [s]
//
// At constant pressure and length F grows to F (1 + sum chi_i); where Eff is constant, exactly as
// F (1 + sum chi_i (1 - exp(-t/t_i))) after a step of the pressure. The law delays the pressure,
// not the tension: a muscle with delayed stretch would return more energy than it received. At
// constant pressure, at rest, the tension is a function of length alone and loops of length are
// closed. The pressure of sealed air follows the length: its delay returns energy, most to swings
// of the period 2 pi t_i.
//
// Not in the thesis. Bounded by the past pressures; stable in steps up to 2.5 t_i.
#pragma once

#include "sinew/actuator/actuator.h"
#include "sinew/actuator/tension.h"

namespace sinew::actuator {

// Returns whether there is creep to integrate.
constexpr bool has_creep(const Creep& creep) {
  for (const double share : creep.share)
    if (share != 0) return true;
  return false;
}

// Returns P_late' [Pa/s].
constexpr double creep_rate(double time, double gauge_pressure, double late) {
  return (gauge_pressure - late) / time;
}

// Returns the tension that one element adds [N].
inline double creep_tension(const Actuator& a, double share, double length, double late,
                            double atmosphere) {
  return share * (clamped_tension(a, length, 0.0, late, atmosphere) -
                  clamped_tension(a, length, 0.0, 0.0, atmosphere));
}

}  // namespace sinew::actuator
