// run/bring_up/pins.h - pins of the inputs and outputs of each board that the firmware supports, by
// the names that are printed on the board.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace sinew::run {

struct Pins {
  std::string_view board;
  std::span<const std::string_view> inputs, outputs;  // input i is inputs[i]
  std::string_view supply;                            // pin of the supply's dump valve
  std::string_view line;                              // "PA9 out, PA10 in"
};

// Returns the pins of all boards that have pins; a board in an emulator has none.
std::span<const Pins> all_pins();

// Returns nullptr for a board that has no pins or is unknown.
const Pins* pins_of(std::string_view board);

// Returns " (PA1)" for pins[number], "" if it does not exist.
std::string in_brackets(std::span<const std::string_view> pins, std::size_t number);

}  // namespace sinew::run
