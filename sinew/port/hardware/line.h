// port/hardware/line.h - bytes to a board and from it: a serial device, an emulator, a test's
// board in the same process.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

namespace sinew::plant {

struct BoardLine {
  // Sends all of the bytes; false once the line is gone.
  std::function<bool(std::span<const std::uint8_t>)> write;
  // Waits for bytes, `seconds` of the board's time at most. Returns how many came, 0 where none
  // did, and -1 once the line is gone.
  std::function<std::ptrdiff_t(std::span<std::uint8_t>, double seconds)> read;
  // Returns the board's time since any instant [s], by which a host's patience ends; empty: that of
  // the wall. A line that waits for its host has a clock of its own.
  std::function<double()> now = {};
};

}  // namespace sinew::plant
