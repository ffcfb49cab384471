// identify/valve/chamber.h - pressure in a chamber behind a valve, as a fit has to predict it.
//
//   rho = rho_atm (P/P_atm)^(1/n_p)        dP/dt = m'/(V d rho/dP + rho dV/dP)            [38]-[40]
//   m'  = orifice [42]-[44] or ISO 6358 (gas/orifice.h), from the port's constant pressure
//
// in three shapes:
//
//   rigid   V constant
//   soft    V = V_end (1 - eps_V exp(-(P - P_start)/P_s)): a muscle that swells as it fills
//   hose    a share eps_h of V is before a hose of conductance kappa_h C, and so is the sensor
//
// All flows are per volume (V or V_end = 1), so only C/V matters. Integrated in y =
// (P/P_atm)^(1/7), by RK4 with steps that stay stable where the flow turns linear.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "sinew/gas/air.h"
#include "sinew/gas/valve.h"

namespace sinew::identify {

struct Chamber {
  // Says what the valve fills: walls that do not give way, a muscle's that do, or a hose on the way
  // to it.
  enum class Shape { rigid, soft, hose };

  Shape shape = Shape::rigid;
  gas::Flow::Law law = gas::Flow::Law::iso6358;
  double conductance = 0;     // C/V, of an orifice that of its choked flow [1/(s Pa)]
  double critical_ratio = 0;  // b_crit, ISO 6358 only [-]
  double exponent = 1;        // n [-]
  double port = 0;            // pressure on the valve's other side [Pa abs]
  double start = 0;           // pressure before the valve opens [Pa abs]
  double leak = 0;            // conductance to the room over the valve's [-]
  double share = 0;           // s, soft and hose [-]
  double swell = 1e5;         // P_s, soft [Pa]
  double hose = 1;            // h, hose [-]
  double vent = 0;            // conductance to the room while the valve is shut, over C [-]
};

// A valve's real, not electrical, edge.
struct Opening {
  double time = 0;  // [s]
  bool open = true;
};

// Pressure at the times [Pa abs]; neither times nor openings may fall. False where there is no
// answer: numbers that are no model, or more steps than are sensible.
bool simulate(const Chamber& chamber, const gas::Air& air, std::span<const Opening> openings,
              std::span<const double> times, std::span<double> pressure);

}  // namespace sinew::identify
