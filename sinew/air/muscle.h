// air/muscle.h - what pulls a joint: braided actuators in parallel, their air, their valves.
#pragma once

#include <string>

#include "sinew/actuator/actuator.h"
#include "sinew/gas/hose.h"
#include "sinew/gas/leak.h"
#include "sinew/gas/valve.h"

namespace sinew::air {

struct Muscle {
  std::string name;
  actuator::Actuator actuator;  // one of the bundle
  int count = 1;                // in parallel, sharing one air volume
  double external_volume = 0;   // hoses and fittings of the bundle, downstream of the valves [m^3]
  gas::Valve inlet;             // from the supply; a 3-way valve stands here and serves both ways
  gas::Valve exhaust;           // to the atmosphere
  gas::Hose hose;               // between the valves and the rest
  gas::Leak leak;               // of the muscle
};

}  // namespace sinew::air
