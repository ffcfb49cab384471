// tests/guards/board_monitor.h - a recorder on the wires between a board and its machine: it has
// the valves and the times of the faults, and nothing of the board's program.
//
// Times are ticks of the board's run. Host and board may call it from threads of their own.
#pragma once

#include <cstdint>
#include <mutex>
#include <vector>

#include "sinew/experiment/experiment.h"
#include "sinew/port/hardware/emulator.h"

namespace sinew::run {

class Monitor {
 public:
  explicit Monitor(const experiment::Experiment& e);

  // Connects a board with this body; `mishap` affects the board once, at the first reading from
  // that tick on at which an inlet is open.
  plant::Wires at(plant::Wires body, signals::Tick from = 0, plant::BoardFailure failure = {});

  // Call it when bytes are sent to the board.
  void host_speaks(signals::Tick now);
  // Call it when a fault occurs at the board.
  void board_suffers();

  struct Facts {
    signals::Tick now = 0;       // when something came by last
    signals::Tick failure = -1;  // when it came; -1: not yet
    signals::Tick unheard = 0;  // for how long at most an inlet was open without a word of the host
    bool both_open = false;     // inlet and exhaust of one muscle, ever
    bool open_without_run = false;  // any valve while nothing ran, ever
    bool runs = false;
    bool has_current = true;  // the coils
    std::uint32_t open = 0;   // valves

    bool at_rest() const { return !runs && open == 0; }
  };
  Facts facts() const;
  signals::Tick now() const { return facts().now; }

  // The last tick of a time in which an inlet was open; -1: none was.
  signals::Tick last_inlet(signals::Tick from, signals::Tick until) const;
  // The first tick from there on in which no inlet is open; -1: there was none.
  signals::Tick inlets_shut(signals::Tick from) const { return first(from, inlets_, 0); }
  // The first tick from there on in which all exhausts are open, and no inlet; -1: there was none.
  signals::Tick vented(signals::Tick from) const {
    return first(from, inlets_ | exhausts_, exhausts_);
  }

 private:
  struct Seen {
    signals::Tick tick;
    std::uint32_t open;
  };
  void see(signals::Tick tick, std::uint32_t open, bool current);
  void pass(signals::Tick tick);
  // The first tick from there on in which of these valves those are open, no others.
  signals::Tick first(signals::Tick from, std::uint32_t of, std::uint32_t open) const;

  std::uint32_t inlets_ = 0, exhausts_ = 0;  // of a cylinder only inlets

  std::vector<std::uint32_t> pairs_;

  mutable std::mutex lock_;  // of all below
  std::vector<Seen> seen_;
  Facts facts_;
  signals::Tick heard_ = 0;
};

}  // namespace sinew::run
