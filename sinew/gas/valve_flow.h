// gas/valve_flow.h - flow through an open valve between two pressures, and the time in which it
// fills or vents a rigid volume.
#pragma once

#include <vector>

#include "sinew/gas/air.h"
#include "sinew/gas/valve.h"

namespace sinew::gas {

struct ValveFlow {
  double upstream = 0, downstream = 0;  // [Pa]
  double mass_flow = 0;                 // [kg/s]
  double law_flow = 0;     // flow by the law itself, also where mass_flow is linear [kg/s]
  bool linear = false;     // mass_flow is in the linear part near equal pressures
  double normal_flow = 0;  // volume flow of reference air [m3/s]
  double critical_ratio = 0, ratio = 0;
  double sonic_conductance = 0, area = 0;  // own, and equivalent in the other law

  // Returns whether the flow no longer depends on the downstream pressure.
  bool choked() const { return ratio <= critical_ratio; }
};

// Times in which the volume covers a share of the way between the two pressures.
struct Transfer {
  double share = 0, fill = 0, vent = 0;  // [-], [s]
};

// Names the heat exchange between the volume's air and its walls: none; with the air's wall_time;
// ideal, at the room's temperature; or the polytrope of the air.
enum class Exchange { adiabatic, walls, isothermal, polytrope };

// Returns the flow from `upstream` to `downstream`, absolute [Pa].
ValveFlow flow_through(const Flow& flow, const Air& air, double upstream, double downstream);

// Returns the times for 50, 90 and 99 % of the way in a rigid volume [m3] between the pressures of
// `f`.
std::vector<Transfer> transfers(const Flow& flow, const Air& air, double volume, const ValveFlow& f,
                                Exchange exchange);

}  // namespace sinew::gas
