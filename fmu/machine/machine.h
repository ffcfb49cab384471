// fmu/machine/machine.h - a whole machine with its controllers: an experiment, as run::Simulation
// runs it. The same instants give its bits.
//
// Inputs are settings of the plan that somebody else decides ("control.stiffness.hip"): from the
// first value other than the start they hold in the plan's place, from the next period on. Outputs
// are channels of the log; parameters are values of the experiment's files. A channel that has a
// value only at times is 0 while it has none, with a Boolean output that is true while it has one.
//
// Controllers live in ticks of 0.1 ms. At a communication point between two ticks outputs are those
// of the tick before.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "fmu/slave/sheet.h"
#include "sinew/run/simulation/simulation.h"

namespace sinew::fmu {

// Names what of an experiment an importer sees.
struct MachineShown {
  std::vector<std::string> inputs;      // keys of settings
  std::vector<std::string> outputs;     // channels; empty: all that have a value
  std::vector<std::string> parameters;  // keys of the experiment's numbers
};

class Machine {
 public:
  static constexpr std::string_view kind = "machine";

  // Takes the model that the description tells of. Throws std::exception for what is wrong with it.
  explicit Machine(const Description& description);
  // Throws config::Error or std::exception for an experiment that cannot be built and for names
  // that it does not have.
  static Description describe(const experiment::Experiment& experiment, const MachineShown& shown);

  // The variables, with the values of those that are set.
  const Sheet& sheet() const { return sheet_; }
  Sheet& sheet() { return sheet_; }

  void begin();
  // See instance.h: an output, what forbids a step, the step, and where the plan ends.
  double output(std::size_t place) const;
  std::string wrong(double) const { return {}; }
  const char* advance(double end, double step) noexcept;
  double last() const noexcept { return simulation_->ended() ? simulation_->time() : duration(); }

  // The model's own state as bytes, and back.
  std::vector<std::byte> save() const;
  void restore(std::span<const std::byte> saved);

  // Returns how long the plan takes  [s].
  double duration() const noexcept;

 private:
  struct Shown {
    std::size_t place = 0, number = 0;  // of the variable; of the setting or the channel
    std::string key;
    std::string unit;
    double told = 0;  // inputs: what the simulation was told last
  };

  experiment::Experiment experiment() const;
  void place_variables(const Description& description);
  void place_output(const std::string& name);

  Sheet sheet_;
  config::Node tree_;
  std::vector<Shown> inputs_, parameters_;
  std::unique_ptr<run::Simulation> simulation_;

  // Outputs at the tick that the simulation stands at, read together once one is asked for; the
  // first one's place, after which the others follow.
  std::size_t first_output_ = 0;
  std::vector<std::size_t> channels_;
  enum class Shows { value, value_or_zero, validity };
  std::vector<Shows> shows_;  // by output, of its channel
  mutable std::vector<double> read_;
  mutable bool fresh_ = false;
  std::string cause_;
};

}  // namespace sinew::fmu
