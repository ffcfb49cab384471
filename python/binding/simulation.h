// python/binding/simulation.h - simulation held by Python.
#pragma once

#include <memory>

#include "python/binding/bind.h"
#include "python/binding/used.h"
#include "sinew/run/simulation/simulation.h"

namespace sinew::python {

// Simulation that only one thread at a time may use.
class HeldSimulation : public Guarded<run::Simulation> {
 public:
  explicit HeldSimulation(ExperimentPointer experiment)
      : Guarded("simulation", experiment->read), experiment_(std::move(experiment)) {}

  const ExperimentPointer& experiment() const { return experiment_; }

 private:
  ExperimentPointer experiment_;
};

// Advances by seconds, rounded to ticks, or to the plan's end. Checks for Ctrl-C meanwhile. Throws
// std::invalid_argument for an invalid time, RunError if the run has failed.
void advance(run::Simulation& simulation, double seconds);

// Throws std::invalid_argument for a time that is not finite, or below 0  [s].
void check_time(double seconds);

// Throws RunError if the run ended before its plan.
void refuse_failed(const run::Simulation& simulation);

}  // namespace sinew::python
