// python/binding/simulation.h - a simulation as Python holds it.
#pragma once

#include <memory>

#include "python/binding/bind.h"
#include "python/binding/used.h"
#include "sinew/run/simulation/simulation.h"

namespace sinew::python {

// HeldSimulation lets one thread at a time at a simulation.
class HeldSimulation {
 public:
  explicit HeldSimulation(ExperimentPointer experiment)
      : experiment_(std::move(experiment)), simulation_(experiment_->read) {}

  const ExperimentPointer& experiment() const { return experiment_; }

  // The simulation, as long as a Use of it lives. Throws std::runtime_error where another thread
  // has one.
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

// Advances by seconds, rounded to ticks, or to the plan's end. Looks for Ctrl-C on the way. Throws
// std::invalid_argument for what is no time, RunError where the run has failed.
void advance(run::Simulation& simulation, double seconds);

// Throws std::invalid_argument for a time that is not finite, or below 0  [s].
void check_time(double seconds);

// Throws RunError where the run has ended before its plan did.
void refuse_failed(const run::Simulation& simulation);

}  // namespace sinew::python
