// gas/valve.h - solenoid valve: flow law, delays and coil; or a pressure regulator instead.
//
// The laws of flow are in orifice.h, the delays in delay.h, the coil in coil_current.h.
#pragma once

#include <string>

namespace sinew::gas {

// A proportional pressure regulator instead of a valve: it takes a set point instead of pulses.
//
//   p_set = P_atm + share range           share 0..1, from the controller
//   P_out' = (p_set - P_out)/t_r          outlet pressure at no flow; t_r = 0: no lag
//   m' = flow law of the valve from min(P_out, line) to the muscle; air that flows back is
//        relieved into the room by the same law
//
// A steady bleed of a regulator is modelled as a leak of the muscle.

struct Regulator {
  double range = 0;          // gauge pressure at full share [Pa]
  double time_constant = 0;  // tau [s]
};

// Returns p_set, absolute [Pa].
constexpr double set_point(const Regulator& r, double share, double atmosphere) {
  const double inside = share < 0 ? 0.0 : share > 1 ? 1.0 : share;
  return atmosphere + inside * r.range;
}

// Returns P_out' [Pa/s].
constexpr double outlet_rate(const Regulator& r, double outlet, double set) {
  return r.time_constant > 0 ? (set - outlet) / r.time_constant : 0.0;
}

// Mass flow through the open valve.
struct Flow {
  enum class Law { orifice, appendix_a, iso6358 };  // appendix_a: rounded as in its code
  Law law = Law::orifice;

  // Law::orifice and appendix_a, [42]-[44]
  double area = 0;        // A_p C_q lumped, [43]  [m^2]
  double efficiency = 1;  // factor of the flow, 3.4 (0.85)  [-]

  // Law::iso6358
  double sonic_conductance = 0;        // C [m^3/(s Pa)] at the ISO reference air
  double critical_pressure_ratio = 0;  // b_crit [-]

  double linear_below = 1e-3;  // pressure difference / upstream pressure: dQ/dP is infinite at 0
};

// Times from the electrical edge until the shutter moves [s].
struct Delays {
  double opening = 0, closing = 0;
};

// Electrical power  [W].
struct Coil {
  double power = 0;        // holding power, or constant power
  double boost_power = 0;  // speed-up: power at the start of a pulse
  double boost_time = 0;   // speed-up: [s]
};

// Constants that determine the coil's current, coil_current.h.
struct Circuit {
  double resistance = 0;       // R, including series resistance; 0: unknown [ohm]
  double inductance = 0;       // L [H]
  double hold_voltage = 0;     // while it is on [V]
  double boost_voltage = 0;    // speed-up: instead, for boost_time [V]
  double release_voltage = 0;  // against the current when it is switched off [V]
  double motion_voltage = 0;   // back-EMF of the opening shutter [V]
  double motion_time = 0;      // duration of that motion, until the valve is open [s]
};

struct Valve {
  // three_way: supply or atmosphere, never sealed; regulator: a set point instead of pulses
  enum class Kind { two_way, three_way, regulator };
  enum class Profile { ideal, dead_time, ramp };
  enum class Drive { standard, speed_up };  // speed_up: more current at the edge, 4.3

  std::string name;
  Kind kind = Kind::two_way;
  Flow flow;
  Profile profile = Profile::dead_time;
  double opening_delay = 0;  // [s] from the electrical edge until the shutter moves
  double closing_delay = 0;  // [s]
  double opening_ramp = 0;   // [s] from shut to open, Profile::ramp
  double closing_ramp = 0;   // [s]

  Drive drive = Drive::standard;
  Delays speed_up;                 // instead of the delays above with Drive::speed_up
  double opening_delay_slope = 0;  // delay per pressure difference at the edge [s/Pa]
  double closing_delay_slope = 0;  // [s/Pa]
  double max_frequency = 0;        // largest frequency that the shutter follows; 0: no limit [Hz]
  double fails_above = 0;       // pressure difference that the coil cannot lift; 0: no limit [Pa]
  double rated_switchings = 0;  // openings that it is made for; 0: not given [-]
  Coil coil;
  Circuit circuit;
  Regulator regulator;
};

}  // namespace sinew::gas
