// gas/coil_current.h - current in a valve's coil, as measured in figures 4-8 and 4-9, and its
// energy.
//
//   L_coil di/dt + R_coil i = V_coil - V_emf
//   within a piece   i(t) = i_end + (i_0 - i_end) exp(-(t - t_0) R_coil/L_coil)
//                    i_end = (V_coil - V_emf)/R_coil
//
//   V_coil  boost for the first boost_time of a pulse with the speed-up drive, then hold; after the
//       pulse -release, against the current, which ends at zero
//   V_emf   back-EMF of the shutter while it opens: motion_voltage for motion_time, until the valve
//       is open, opening_delay after the edge. It causes the dip that shows in 4.3 that the
//       shutter has moved. A closing shutter causes none: its current has ended (4.3).
//
//   R_coil, L_coil  resistance [ohm] and inductance [H]   i  current [A]   V_coil, V_emf  [V]
//
// The solution is exact, piece by piece, without steps. A piece ends where V_coil or V_emf jumps,
// or where the current ends. Departures: L_coil does not grow as the gap closes, and V_emf does not
// depend on the shutter's speed or the current; both affect the dip's shape, not its time.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "sinew/gas/delay.h"
#include "sinew/gas/valve.h"

namespace sinew::gas {

// One piece of the current; it begins at `from`.
struct CurrentPiece {
  double from = 0;            // [s]
  double start = 0, end = 0;  // current at `from`, and its limit [A]
  double rate = 0;            // R/L [1/s]

  // Returns the current at t  [A].
  double at(double t) const { return end + (start - end) * std::exp(-(t - from) * rate); }
};

// Returns the current at t of pieces in order; 0 before the first [A].
inline double current(const std::vector<CurrentPiece>& pieces, double t) {
  const CurrentPiece* piece = nullptr;
  for (const CurrentPiece& p : pieces)
    if (p.from <= t) piece = &p;
  return piece ? piece->at(t) : 0.0;
}

namespace detail {

inline void add_piece(std::vector<CurrentPiece>& pieces, const Circuit& c, double t,
                      double voltage) {
  const double start = current(pieces, t);
  pieces.push_back({t, start, voltage / c.resistance, c.resistance / c.inductance});
}

// Adds the pieces while the coil is on: [on, off).
inline void pulse(std::vector<CurrentPiece>& pieces, const Valve& v, double delay, double on,
                  double off) {
  const Circuit& c = v.circuit;
  const double boosted = v.drive == Valve::Drive::speed_up ? on + v.coil.boost_time : on;
  const double open = on + delay, begins = delay > c.motion_time ? open - c.motion_time : on;
  double t = on;
  while (t < off) {
    const double u = t < boosted ? c.boost_voltage : c.hold_voltage;
    const double e = t >= begins && t < open ? c.motion_voltage : 0.0;
    add_piece(pieces, c, t, u - e);
    double next = off;
    for (const double corner : {boosted, begins, open})
      if (corner > t && corner < next) next = corner;
    t = next;
  }
}

// Adds the pieces after a pulse, until the next: a current that has ended stays zero.
inline void release(std::vector<CurrentPiece>& pieces, const Circuit& c, double off, double next) {
  add_piece(pieces, c, off, -c.release_voltage);
  if (!(c.release_voltage > 0)) return;
  const CurrentPiece& p = pieces.back();
  const double ended = off + std::log(1.0 - p.start / p.end) / p.rate;
  if (ended < next) pieces.push_back({ended, 0, 0, p.rate});
}

}  // namespace detail

// Returns the current of a square wave of the coil that starts at t = 0, at a constant pressure
// difference over the valve [Pa]. Requires a circuit with resistance and inductance above zero.
inline std::vector<CurrentPiece> coil_current(const Valve& valve, double pressure_difference,
                                              double period, double duty, int periods) {
  const double delay = delay_at(valve, true, pressure_difference);
  std::vector<CurrentPiece> pieces;
  for (int k = 0; k < periods; ++k) {
    const double on = k * period, off = on + duty * period, next = (k + 1) * period;
    if (off > on) detail::pulse(pieces, valve, delay, on, off);
    if (next > off) detail::release(pieces, valve.circuit, off, next);
  }
  return pieces;
}

// Energy that a valve's coil takes from the battery.
//
//   standard   E = P t_on
//   speed-up   E = P t_on + (P_boost - P) t_boost per opening: boost for at most t_boost, then hold
//
// t_on counts from the electrical edge, dead times included. P, P_boost at the coil's nominal
// voltage [W].

// Returns the energy of one pulse [J].
constexpr double coil_energy_of_pulse(const Valve& valve, double on_time) {
  if (valve.drive != Valve::Drive::speed_up) return valve.coil.power * on_time;
  const double boost = on_time < valve.coil.boost_time ? on_time : valve.coil.boost_time;
  return valve.coil.boost_power * boost + valve.coil.power * (on_time - boost);
}

// Returns the energy of a run from its time with current and its number of pulses [J]. Exact if
// every pulse lasts at least as long as the boost; else too high, by at most the boosts that were
// cut short.
constexpr double coil_energy(const Valve& valve, double on_time, double openings) {
  const double hold = valve.coil.power * on_time;
  if (valve.drive != Valve::Drive::speed_up) return hold;
  return hold + openings * valve.coil.boost_time * (valve.coil.boost_power - valve.coil.power);
}

}  // namespace sinew::gas
