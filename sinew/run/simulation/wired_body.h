// run/simulation/wired_body.h - an experiment's simulated machine at the wires of a board: what
// opens its valves is a board's word, what reads its sensors is a board's converter.
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
  // Throws std::invalid_argument for a robot that no plant can hold, or of several boards.
  explicit WiredBody(const experiment::Experiment& experiment);
  WiredBody(const WiredBody&) = delete;
  WiredBody& operator=(const WiredBody&) = delete;

  // To it; valid as long as this is there.
  plant::Wires wires();

  // The machine itself, and how far its time has come: for who wants to know what is so.
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
  Boards scan_;  // only its scan is used
  std::uint32_t inverted_ = 0, open_ = 0;
  plant::Machine machine_;
  std::optional<FaultyPort> faulty_;
  signals::Port* port_;
  bool started_ = false;
  signals::Tick begun_ = 0,
                now_ = 0;  // of the body's time: this run's start, the last one asked for
  std::vector<signals::Reading> last_;  // by channel: before the run those of the machine at rest
};

}  // namespace sinew::run
