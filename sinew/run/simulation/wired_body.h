// run/simulation/wired_body.h - an experiment's simulated machine at the wires of a board, whose
// outputs open its valves and whose converter reads its sensors.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sinew/control/setup/boards.h"
#include "sinew/experiment/experiment.h"
#include "sinew/port/hardware/emulator.h"
#include "sinew/run/controllers/boards.h"
#include "sinew/run/simulation/faulty_port.h"
#include "sinew/world/machine.h"

namespace sinew::run {

class WiredBody {
 public:
  // Throws std::invalid_argument for a robot that exceeds the limits of the plant or has several
  // boards.
  explicit WiredBody(const experiment::Experiment& experiment);
  WiredBody(const WiredBody&) = delete;
  WiredBody& operator=(const WiredBody&) = delete;

  // Returns the wires to the machine, valid during the lifetime of this object.
  plant::Wires wires();

  // Return the machine itself and its present time, for access to the true state.
  plant::Machine& machine() noexcept { return machine_; }
  signals::Tick now() const noexcept { return now_; }

 private:
  void valves(signals::Tick tick, std::uint32_t open, bool current);
  void drive(signals::Tick tick, std::uint32_t changed, std::uint32_t open);
  signals::Reading read(signals::Channel channel, signals::Tick tick);
  void start();
  signals::Tick at(signals::Tick run);
  std::vector<signals::Reading> at_rest() const;

  experiment::Experiment experiment_;
  control::Board board_;
  Boards scan_;  // its scan alone is used
  std::uint32_t inverted_ = 0, open_ = 0;
  plant::Machine machine_;
  std::optional<FaultyPort> faulty_;
  signals::Port* port_;
  bool started_ = false;
  signals::Tick begun_ = 0,
                now_ = 0;  // [ticks] of the body's time: start of this run, last access
  std::vector<signals::Reading> last_;  // one per channel; before the run: at rest
};

}  // namespace sinew::run
