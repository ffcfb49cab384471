// gas/regulator.h - a proportional pressure regulator instead of a valve: it takes a setpoint
// instead of pulses.
//
//   p_set = P_atm + share range           share 0..1, the controller's
//   P_out' = (p_set - P_out)/t_r          outlet pressure at no flow, t_r = 0: at once
//   m' = flow law of the valve from min(P_out, line) to the muscle; what comes back is
//        relieved into the room by the same law
//
// Air that a regulator bleeds all the time is a leak of the muscle's table, not of this one.
#pragma once

namespace sinew::gas {

struct Regulator {
  double range = 0;          // gauge pressure at full share [Pa]
  double time_constant = 0;  // tau [s]
};

// p_set, absolute  [Pa].
constexpr double set_point(const Regulator& r, double share, double atmosphere) {
  const double inside = share < 0 ? 0.0 : share > 1 ? 1.0 : share;
  return atmosphere + inside * r.range;
}

// P_out'  [Pa/s].
constexpr double outlet_rate(const Regulator& r, double outlet, double set) {
  return r.time_constant > 0 ? (set - outlet) / r.time_constant : 0.0;
}

}  // namespace sinew::gas
