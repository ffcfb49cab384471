// design/air_use.h - consumption of air as a run, a table of a sweep or a muscle's file has it.
#pragma once

#include <string>
#include <vector>

#include "sinew/design/air.h"
#include "sinew/design/settings.fields.h"

namespace sinew::design {

// Consumption, one for each run, and the air of the machine.
struct AirUses {
  std::string title;  // "the run walk-test-1", for the result's first line
  std::vector<AirUse> runs;
  gas::Air air;
  double line = 0;  // absolute pressure of the supply; NaN: unknown [Pa]
  int muscles = 0;  // 0: unknown
  std::vector<std::string> notes, warnings;
};

// Reads the consumption that the settings name: a run's folder or summary, the table of a sweep, or
// a file with an actuator. Throws config::Error, also for a consumption of zero.
AirUses air_uses(const AirSettings& settings);

}  // namespace sinew::design
