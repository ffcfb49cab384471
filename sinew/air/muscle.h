// air/muscle.h - muscle of a joint: braided actuators in parallel, their air, their valves.
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
  gas::Valve inlet;             // supply side; a 3-way valve or a regulator serves both ways
  gas::Valve exhaust;           // to the atmosphere
  gas::Hose hose;               // between the valves and the rest
  gas::Leak leak;               // leak of the muscle
};

}  // namespace sinew::air
