// plant/hardware/emulated_board.h - a controller board's real program in QEMU, in lock step with
// the body that it drives: the emulator stands still while the host thinks, so that a run is the
// same each time, whatever else the computer does (control/board/lock_step.h has the records).
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sinew/plant/hardware/line.h"
#include "sinew/plant/hardware/remote_board.h"
#include "sinew/signals/port.h"

namespace sinew::plant {

// What the board's valves and its converter are connected to, in the board's numbers and the run's
// ticks; -1 while nothing runs.
struct Wires {
  // Valves have changed: bit i is open now. Without current all coils are at rest.
  std::function<void(signals::Tick tick, std::uint32_t open, bool current)> valves;
  std::function<signals::Reading(signals::Channel, signals::Tick tick)> read;
};

class EmulatedBoard {
 public:
  // Starts the emulator with a program of firmware/ (`lock-step.elf`). Throws BoardError where that
  // does not go.
  EmulatedBoard(const std::string& image, Wires wires);
  ~EmulatedBoard();
  EmulatedBoard(const EmulatedBoard&) = delete;
  EmulatedBoard& operator=(const EmulatedBoard&) = delete;

  // To it; valid as long as the board is there. Time of the line is the board's: a read waits for
  // so many of its periods.
  BoardLine line();

  // Ends the program. Returns what it had of memory, where it still answered.
  struct Sizes {
    std::uint32_t stack = 0, memory = 0;  // [bytes]
  };
  std::optional<Sizes> end() noexcept;

 private:
  std::ptrdiff_t read(std::span<std::uint8_t> out, double seconds);
  void answer_period();
  bool record();  // true: a period begins
  void valves();
  void reading();

  bool fill();
  std::uint8_t byte();
  std::int64_t number(int bytes);
  void put(std::span<const std::uint8_t> bytes);
  void start(const std::string& image);
  void open_pipes();
  void quit() noexcept;

  Wires wires_;
  std::string folder_, from_path_, to_path_;
  pid_t emulator_ = -1;
  int from_ = -1, to_ = -1;
  std::vector<std::uint8_t> buffer_;
  std::size_t first_ = 0;
  std::vector<std::uint8_t> in_, out_;  // of the line
  bool waits_ = false;                  // the board, for what is to go into its line
  bool gone_ = false;
  std::optional<Sizes> sizes_;
};

}  // namespace sinew::plant
