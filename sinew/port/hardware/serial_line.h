// port/hardware/serial_line.h - a serial device as the line to a board.
#pragma once

#include <cstdint>
#include <string>

#include "sinew/port/hardware/line.h"

namespace sinew::plant {

class SerialLine {
 public:
  // Opens the device exclusively, in raw mode with 8 bits, no parity and `baud` bits per second.
  // Throws BoardError with the reason: no such device, no permission, the device is in use, or it
  // does not support the rate.
  SerialLine(const std::string& device, std::uint32_t baud);
  ~SerialLine();
  SerialLine(const SerialLine&) = delete;
  SerialLine& operator=(const SerialLine&) = delete;

  // Returns functions that use this object; they are valid as long as it exists.
  BoardLine line();

 private:
  bool write(std::span<const std::uint8_t> bytes) const;
  std::ptrdiff_t read(std::span<std::uint8_t> out, double seconds) const;

  int file_ = -1;
};

// Returns the rates that a serial line may have, ascending.
std::span<const std::uint32_t> serial_rates();

}  // namespace sinew::plant
