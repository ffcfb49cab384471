// fmu/machine/machine.h - FMU model of a whole machine with its controllers: an experiment,
// simulated by run::Simulation. With communication points at the same instants the results are
// equal to the bit.
//
// Inputs are settings of the plan that the importer may override ("control.stiffness.hip"): from
// the first value that differs from the start, they replace the plan's values from the next period
// on. Outputs are channels of the log; parameters are values of the experiment's files. A
// channel that has values only at some times is 0 at other times, and a Boolean output shows
// whether it has a value.
//
// Controllers run in ticks of 0.1 ms. At a communication point between two ticks, the outputs are
// those of the earlier tick.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "fmu/slave/sheet.h"
#include "sinew/run/simulation/simulation.h"

namespace sinew::fmu {

// Variables of an experiment that an importer can access.
struct ExposedVariables {
  std::vector<std::string> inputs;      // keys of settings
  std::vector<std::string> outputs;     // channels; empty: all that have a value
  std::vector<std::string> parameters;  // keys of the experiment's numbers
};

class Machine {
 public:
  static constexpr std::string_view kind = "machine";

  // Builds the model of a description. Throws std::exception if the description is invalid.
  explicit Machine(const Description& description);
  // Returns the description of an experiment. Throws config::Error or std::exception for an
  // experiment that cannot be built and for unknown names.
  static Description describe(const experiment::Experiment& experiment,
                              const ExposedVariables& shown);

  // Return the variables, with the values that were set.
  const Sheet& sheet() const { return sheet_; }
  Sheet& sheet() { return sheet_; }

  void begin();
  // See instance.h: an output, the reason why a step is refused, the step, and the end of the plan.
  double output(std::size_t place) const;
  std::string refusal(double) const { return {}; }
  const char* advance(double end, double step) noexcept;
  double last() const noexcept { return simulation_->ended() ? simulation_->time() : duration(); }

  // Save and restore the model's own state as bytes.
  std::vector<std::byte> save() const;
  void restore(std::span<const std::byte> saved);

  // Returns the duration of the plan [s].
  double duration() const noexcept;

 private:
  struct ExposedVariable {
    std::size_t place = 0, number = 0;  // of the variable; of the setting or channel
    std::string key;
    std::string unit;
    double last_value = 0;  // inputs: value that was last passed to the simulation
  };

  experiment::Experiment experiment() const;
  void place_variables(const Description& description);
  void place_output(const std::string& name);

  Sheet sheet_;
  config::Node tree_;
  std::vector<ExposedVariable> inputs_, parameters_;
  std::unique_ptr<run::Simulation> simulation_;

  // Outputs at the simulation's present tick, read together when one is read first. They follow
  // each other, beginning with this variable.
  std::size_t first_output_ = 0;
  std::vector<std::size_t> channels_;
  enum class Shows { value, value_or_zero, validity };
  std::vector<Shows> shows_;  // one per output: how it shows its channel
  mutable std::vector<double> read_;
  mutable bool fresh_ = false;
  std::string cause_;
};

}  // namespace sinew::fmu
