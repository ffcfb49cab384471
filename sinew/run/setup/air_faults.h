// run/setup/air_faults.h - the faults of an experiment as they act in the simulated air.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "sinew/air/fault.h"
#include "sinew/experiment/experiment.h"
#include "sinew/experiment/faults.h"

namespace sinew::run {

// The air that faults break: its parts and its room, and the hole where a muscle is ruptured.
struct FaultyAir {
  std::vector<experiment::FaultPart> parts;
  double atmosphere = 0;                 // absolute [Pa]
  std::function<double(int)> tear = {};  // of a muscle, by its index [m^2]
};

// Returns a tenth of the cross-section of one actuator at that length: a tear that the braid holds
// together, a guess  [m^2].
double tear_of(const actuator::Actuator& actuator, double length);

// Adds that there are more faults of the air than an air network schedules.
void check_air_faults(std::span<const experiment::Fault> faults,
                      std::vector<robot::Contradiction>& out);

// Returns the faults of the air, in their order, for a plant. Expects a list without
// contradictions.
std::vector<air::AirFault> air_faults(std::span<const experiment::Fault> faults,
                                      const FaultyAir& air);
std::vector<air::AirFault> air_faults(const experiment::Experiment& experiment);

}  // namespace sinew::run
