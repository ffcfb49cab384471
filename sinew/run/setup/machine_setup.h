// run/setup/machine_setup.h - setup of the simulated world of an experiment.
#pragma once

#include <span>
#include <vector>

#include "sinew/air/fault.h"
#include "sinew/air/muscle.h"
#include "sinew/experiment/experiment.h"
#include "sinew/mechanism/planar/setup.h"
#include "sinew/mechanism/slide/setup.h"
#include "sinew/world/machine.h"

namespace sinew::run {

// Returns the robot's muscles with their actuators and valves, in its order.
std::vector<air::Muscle> muscles_of(const experiment::Experiment& experiment);

// Returns a planar world for the experiment's robot.
plant::Setup planar_setup(const experiment::Experiment& experiment);

// Returns the planar world, or the experiment's test stand.
plant::AnySetup machine_setup(const experiment::Experiment& experiment);

// Adds a contradiction if there are more faults of the air than an air network can schedule.
void check_air_faults(std::span<const experiment::Fault> faults,
                      std::vector<robot::Contradiction>& out);

// Returns the faults of the air of a robot, in their order. The list [[fault]] must have no
// contradictions.
std::vector<air::AirFault> air_faults(const experiment::Experiment& experiment);

// Returns the stand of an experiment that has one, with its faults. The list [[fault]] must have no
// contradictions.
plant::StandSetup stand_setup(const experiment::Experiment& experiment);

// Adds what the world itself refuses, for example a load that has no equilibrium at any length.
void check_stand_setup(const experiment::Experiment& experiment,
                       std::vector<robot::Contradiction>& wrong);

}  // namespace sinew::run
