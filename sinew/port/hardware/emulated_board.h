// port/hardware/emulated_board.h - a controller board's real program in QEMU, in one of two ways:
//
//   LockStepBoard    the emulator waits for its host in each period: a run is the same each time,
//                    whatever else the computer does, and has the simulation's bits
//   EmulatedBoard    the whole application with its interrupts at its emulated serial line, where
//                    host and board have clocks of their own, as on a bench
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "sinew/port/hardware/emulator.h"
#include "sinew/port/hardware/line.h"

namespace sinew::plant {

// A board's program that is run tick by tick.
class LockStepBoard {
 public:
  // Starts `lock-step.elf`. Throws BoardError.
  LockStepBoard(const std::string& image, Wires wires);

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

  Emulator emulator_;
  std::vector<std::uint8_t> in_, out_;  // of the line
  bool waits_ = false;                  // the board, for what is to go into its line
  bool gone_ = false;
  std::int64_t periods_ = 0;  // that it was let run for
  std::optional<Sizes> sizes_;
};

class EmulatedBoard {
 public:
  // Starts an `application-….elf`. Throws BoardError.
  EmulatedBoard(const std::string& image, Wires wires);
  ~EmulatedBoard();
  EmulatedBoard(const EmulatedBoard&) = delete;
  EmulatedBoard& operator=(const EmulatedBoard&) = delete;

  // To it; valid as long as the board is there. Time of the line is that of the wall.
  BoardLine line();

 private:
  std::ptrdiff_t read(std::span<std::uint8_t> out, double seconds) const;
  bool write(std::span<const std::uint8_t> bytes) const;

  struct Sockets {
    Sockets();
    ~Sockets();
    int ours = -1, its = -1;
  };
  Sockets sockets_;
  Emulator emulator_;
  std::thread wires_;  // serves them; nobody else touches the emulator's pipes
};

}  // namespace sinew::plant
