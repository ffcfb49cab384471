// gas/valve_flow.h - what flows through an open valve between two pressures, and how long a rigid
// volume takes between them.
#pragma once

#include <vector>

#include "sinew/gas/air.h"
#include "sinew/gas/valve.h"

namespace sinew::gas {

struct ValveFlow {
  double upstream = 0, downstream = 0;  // [Pa]
  double mass_flow = 0;                 // [kg/s]
  double law_flow = 0;                  // of the law itself, also where mass_flow is linear [kg/s]
  bool linear = false;                  // so near to equal pressures that mass_flow is linear
  double normal_flow = 0;               // of reference air [m3/s]
  double critical_ratio = 0, ratio = 0;
  double sonic_conductance = 0, area = 0;  // of either law, and what it equals in the other

  // Does the pressure downstream no longer matter?
  bool choked() const { return ratio <= critical_ratio; }
};

// When the volume has gone a share of the way between the two pressures.
struct Transfer {
  double share = 0, fill = 0, vent = 0;  // [-], [s]
};

// Names how the air of the volume exchanges heat with its walls: not; with the air's wall_time; so
// quickly that it keeps the room's temperature; or as the polytrope of the air has it.
enum class Exchange { adiabatic, walls, isothermal, polytrope };

// Returns the flow from `upstream` to `downstream` [Pa abs].
ValveFlow flow_through(const Flow& flow, const Air& air, double upstream, double downstream);

// Returns the times for 50, 90 and 99 % of the way in a rigid volume [m3] between the pressures of
// `f`.
std::vector<Transfer> transfers(const Flow& flow, const Air& air, double volume, const ValveFlow& f,
                                Exchange exchange);

}  // namespace sinew::gas
