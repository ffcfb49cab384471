// python/binding/simulation.h - simulation held by Python.
#pragma once

#include <memory>

#include "python/binding/bind.h"
#include "python/binding/used.h"
#include "sinew/run/simulation/simulation.h"

namespace sinew::python {

// Simulation that only one thread at a time may use.
class HeldSimulation {
 public:
  explicit HeldSimulation(ExperimentPointer experiment)
      : experiment_(std::move(experiment)), simulation_(experiment_->read) {}

  const ExperimentPointer& experiment() const { return experiment_; }

  // Access to the simulation during the lifetime of this object. Throws std::runtime_error if
  // another thread uses the simulation.
  class Use {
   public:
    explicit Use(HeldSimulation& held) : held_(held), now_(held.used_, "simulation") {}

    run::Simulation* operator->() const { return &held_.simulation_; }
    run::Simulation& operator*() const { return held_.simulation_; }

   private:
    HeldSimulation& held_;
    Used::Now now_;
  };

 private:
  ExperimentPointer experiment_;
  run::Simulation simulation_;
  Used used_;
};

// Advances by seconds, rounded to ticks, or to the plan's end. Checks for Ctrl-C meanwhile. Throws
// std::invalid_argument for an invalid time, RunError if the run has failed.
void advance(run::Simulation& simulation, double seconds);

// Throws std::invalid_argument for a time that is not finite, or below 0  [s].
void check_time(double seconds);

// Throws RunError if the run ended before its plan.
void refuse_failed(const run::Simulation& simulation);

}  // namespace sinew::python
