// port/hardware/line.h - a two-way stream of bytes to a board: a serial device, an emulator, or a
// test's board in the same process.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

namespace sinew::plant {

struct BoardLine {
  // Sends all bytes. Returns false once the line is closed.
  std::function<bool(std::span<const std::uint8_t>)> write;
  // Waits for bytes, at most `seconds` of the board's time. Returns the number of bytes that
  // arrived, 0 if none did, and -1 once the line is closed.
  std::function<std::ptrdiff_t(std::span<std::uint8_t>, double seconds)> read;
  // Returns the board's time since an arbitrary instant [s], which a host uses for its timeouts;
  // empty: wall time. A line that waits for its host has a clock of its own.
  std::function<double()> now = {};
};

}  // namespace sinew::plant
