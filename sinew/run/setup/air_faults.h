// run/setup/air_faults.h - an experiment's faults as faults of the simulated air.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "sinew/air/fault.h"
#include "sinew/experiment/experiment.h"
#include "sinew/experiment/faults.h"

namespace sinew::run {

// The parts of the air that faults act on, its atmosphere, and the hole of a ruptured muscle.
struct FaultyAir {
  std::vector<experiment::FaultPart> parts;
  double atmosphere = 0;                 // absolute [Pa]
  std::function<double(int)> tear = {};  // area for a muscle, by its index [m^2]
};

// Returns the assumed area of a tear that the braid holds together: a tenth of the cross-section of
// one actuator at that length [m^2].
double tear_area(const actuator::Actuator& actuator, double length);

// Adds a contradiction if there are more faults of the air than an air network can schedule.
void check_air_faults(std::span<const experiment::Fault> faults,
                      std::vector<robot::Contradiction>& out);

// Return the faults of the air, in their order, for a plant. The list must have no contradictions.
std::vector<air::AirFault> air_faults(std::span<const experiment::Fault> faults,
                                      const FaultyAir& air);
std::vector<air::AirFault> air_faults(const experiment::Experiment& experiment);

}  // namespace sinew::run
