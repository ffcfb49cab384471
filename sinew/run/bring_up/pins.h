// run/bring_up/pins.h - on which pins a board's port of the firmware has its inputs and outputs, by
// the names that are printed beside them.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace sinew::run {

struct Pins {
  std::string_view board;
  std::span<const std::string_view> inputs, outputs;  // input i is inputs[i]
  std::string_view supply;                            // of the supply's dump valve
  std::string_view line;                              // "PA9 out, PA10 in"
};

// Those of all boards that have pins; one in an emulator has none.
std::span<const Pins> all_pins();

// nullptr for a board that has none, or is not known.
const Pins* pins_of(std::string_view board);

// Returns " (PA1)" for pins[number], "" where there is none.
std::string in_brackets(std::span<const std::string_view> pins, std::size_t number);

}  // namespace sinew::run
