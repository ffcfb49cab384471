// identify/valve/chamber.h - simulated pressure in a chamber behind a valve, for fits.
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
// (P/P_atm)^(1/7) by RODAS3 (air/stiff/quick.h) with step control, stable where the flow becomes
// linear.
#pragma once

#include <span>

#include "sinew/gas/air.h"
#include "sinew/gas/valve.h"

namespace sinew::identify {

struct Chamber {
  // Shape of the filled volume: rigid walls, walls that expand as those of a muscle, or a hose
  // before the volume.
  enum class Shape { rigid, soft, hose };

  Shape shape = Shape::rigid;
  gas::Flow::Law law = gas::Flow::Law::iso6358;
  double conductance = 0;     // C/V, for an orifice that of its choked flow [1/(s Pa)]
  double critical_ratio = 0;  // b_crit, ISO 6358 only [-]
  double exponent = 1;        // n_p [-]
  double port = 0;            // pressure on the valve's other side [Pa abs]
  double start = 0;           // pressure before the valve opens [Pa abs]
  double leak = 0;            // conductance of a leak to the room, relative to the valve's [-]
  double share = 0;           // eps_V, soft, or eps_h, hose [-]
  double swell = 1e5;         // P_s, soft [Pa]
  double hose = 1;            // kappa_h, hose [-]
  double vent = 0;            // conductance to the room while the valve is shut, relative to C [-]
};

// A mechanical, not electrical, edge of a valve.
struct Opening {
  double time = 0;  // [s]
  bool open = true;
};

// Computes the absolute pressure at the times [Pa]; times and openings must be non-decreasing.
// Returns false if the parameters are not valid or too many steps are necessary.
bool simulate(const Chamber& chamber, const gas::Air& air, std::span<const Opening> openings,
              std::span<const double> times, std::span<double> pressure);

}  // namespace sinew::identify
