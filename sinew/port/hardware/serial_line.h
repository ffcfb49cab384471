// port/hardware/serial_line.h - a serial device as the line to a board.
#pragma once

#include <cstdint>
#include <string>

#include "sinew/port/hardware/line.h"

namespace sinew::plant {

class SerialLine {
 public:
  // Opens the device for this program alone, raw, 8 bits without parity, at `baud` bits a second.
  // Throws BoardError that says what is in the way: no such device, no permission, another
  // program at it, a rate that it cannot have.
  SerialLine(const std::string& device, std::uint32_t baud);
  ~SerialLine();
  SerialLine(const SerialLine&) = delete;
  SerialLine& operator=(const SerialLine&) = delete;

  // To it; valid as long as this is there.
  BoardLine line();

 private:
  bool write(std::span<const std::uint8_t> bytes) const;
  std::ptrdiff_t read(std::span<std::uint8_t> out, double seconds) const;

  int file_ = -1;
};

// The rates that a serial line may have, ascending.
std::span<const std::uint32_t> serial_rates();

}  // namespace sinew::plant
