// gas/valve.h - a solenoid valve: its flow law, and when it really opens.
//
// Laws of flow stand in orifice.h, the delays in delay.h.
#pragma once

#include <string>

namespace sinew::gas {

// Mass flow through the open valve.
struct Flow {
  enum class Law { orifice, iso6358 };
  Law law = Law::orifice;

  // Law::orifice, [42]-[44]
  double area = 0;        // A_p C_q lumped, [43]  [m^2]
  double efficiency = 1;  // times the flow, 3.4 (0.85)  [-]

  // Law::iso6358
  double sonic_conductance = 0;        // C [m^3/(s Pa)] at the ISO reference air
  double critical_pressure_ratio = 0;  // b [-]

  double linear_below = 1e-3;  // of pressure difference / upstream pressure: dQ/dP is infinite at 0
};

struct Valve {
  enum class Kind { two_way, three_way };  // three_way: supply or atmosphere, never sealed
  enum class Profile { ideal, dead_time, ramp };

  std::string name;
  Kind kind = Kind::two_way;
  Flow flow;
  Profile profile = Profile::dead_time;
  double opening_delay = 0;  // [s] from the electrical edge until the shutter moves
  double closing_delay = 0;  // [s]
  double opening_ramp = 0;   // [s] from shut to open, Profile::ramp
  double closing_ramp = 0;   // [s]
};

}  // namespace sinew::gas
