// port/hardware/emulator.h - a board's program in QEMU with a plant at its wires. The emulator
// waits while the plant's side replies (control/board/lock_step.h has the records).
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "sinew/signals/port.h"

namespace sinew::plant {

// Failure of a board's program itself, for tests. A stall longer than the watchdog's time looks
// like a program that hangs.
struct BoardFailure {
  // Kind of failure: none, a stall of `ticks` ticks, or a reset.
  enum class What : std::uint8_t { none, stall, reset } what = What::none;
  std::uint16_t ticks = 0;
};

// Functions that connect the board's valves and its converter to a plant, in the board's numbers
// and the run's ticks; the tick is -1 outside a run.
struct Wires {
  // Called when valves have changed: bit i is set if valve i is open. Without current all coils are
  // at rest.
  std::function<void(signals::Tick tick, std::uint32_t open, bool current)> valves;
  std::function<signals::Reading(signals::Channel, signals::Tick tick)> read;
  // Called before each reading, for an application only; empty: no failures.
  std::function<BoardFailure(signals::Tick tick)> failure = {};
};

class Emulator {
 public:
  struct Closed {};  // the process has ended or sent an unexpected record

  // Starts a program of firmware/. `line` is a socket whose other end is the program's serial line;
  // -1: the program has no serial line. Throws BoardError if the program cannot be started.
  Emulator(const std::string& image, Wires wires, int line);
  ~Emulator() { quit(); }
  Emulator(const Emulator&) = delete;
  Emulator& operator=(const Emulator&) = delete;

  // Serves the wires until a record of another kind arrives, and returns its letter. This function
  // and the next two throw Closed.
  std::uint8_t next_record();
  std::int64_t number(int bytes);
  void put(std::span<const std::uint8_t> bytes);

  // Ends the process at once. A call that waits for a record then throws Closed.
  void kill() noexcept;

 private:
  void start(const std::string& image, int line);
  void open_pipes();
  void quit() noexcept;
  bool fill();
  std::uint8_t byte();
  void valves();
  void reading();
  bool send_failure(signals::Tick tick);

  Wires wires_;
  std::string folder_, from_path_, to_path_;
  pid_t process_ = -1;
  int from_ = -1, to_ = -1;
  std::vector<std::uint8_t> buffer_;
  std::size_t first_ = 0;
};

}  // namespace sinew::plant
