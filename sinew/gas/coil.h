// gas/coil.h - what a valve's coil takes from the battery.
//
//   standard   E = P t_on
//   speed-up   E = P t_on + (P_boost - P) t_boost per opening: a boost of at most t_boost, then
//   hold
//
// t_on counts from the electrical edge, dead times included. P, P_boost at the coil's nominal
// voltage [W].
#pragma once

#include "sinew/gas/valve.h"

namespace sinew::gas {

// One pulse  [J].
constexpr double coil_energy_of_pulse(const Valve& valve, double on_time) {
  if (valve.drive != Valve::Drive::speed_up) return valve.coil.power * on_time;
  const double boost = on_time < valve.coil.boost_time ? on_time : valve.coil.boost_time;
  return valve.coil.boost_power * boost + valve.coil.power * (on_time - boost);
}

// A run, from the time with current and the number of its pulses  [J]. Exact while every pulse
// lasts as long as the boost; else too high, by at most the boosts that were cut short.
constexpr double coil_energy(const Valve& valve, double on_time, double openings) {
  const double hold = valve.coil.power * on_time;
  if (valve.drive != Valve::Drive::speed_up) return hold;
  return hold + openings * valve.coil.boost_time * (valve.coil.boost_power - valve.coil.power);
}

}  // namespace sinew::gas
