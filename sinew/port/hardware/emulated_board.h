// port/hardware/emulated_board.h - a controller board's real program in QEMU, run in two ways:
//
//   LockStepBoard    the emulator waits for its host in each period: a run is the same each time,
//                    whatever else the computer does, and has the simulation's bits
//   EmulatedBoard    the whole application with its interrupts at its emulated serial line, where
//                    host and board have separate clocks, as on a bench
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

  // Returns functions that use this object; they are valid as long as it exists. The line's time is
  // the board's: a read of `seconds` waits for that many of the board's periods of 10 ms.
  BoardLine line();

  // Ends the program. Returns its use of memory, if it still replied.
  struct Sizes {
    std::uint32_t stack = 0, memory = 0;  // [bytes]
  };
  std::optional<Sizes> end() noexcept;

 private:
  std::ptrdiff_t read(std::span<std::uint8_t> out, double seconds);
  void send_period();
  bool record();  // returns whether a period begins

  Emulator emulator_;
  std::vector<std::uint8_t> in_, out_;  // pending bytes of the line
  bool waits_ = false;                  // whether the board waits for the bytes of its line
  bool closed_ = false;
  std::int64_t periods_ = 0;  // number of periods it has run
  std::optional<Sizes> sizes_;
};

class EmulatedBoard {
 public:
  // Starts an `application-….elf`. Throws BoardError.
  EmulatedBoard(const std::string& image, Wires wires);
  ~EmulatedBoard();
  EmulatedBoard(const EmulatedBoard&) = delete;
  EmulatedBoard& operator=(const EmulatedBoard&) = delete;

  // Returns functions that use this object; they are valid as long as it exists. The line's time is
  // wall time.
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
  std::thread wires_;  // serves the emulator's pipes; no other thread may touch them
};

}  // namespace sinew::plant
