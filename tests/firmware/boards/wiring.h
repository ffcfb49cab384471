// tests/firmware/boards/wiring.h - where a board's pins and timers are, written independently with
// the reference manual's names, for the tests of its port.
#pragma once

#include <cstdint>
#include <string>

#include "firmware/board.h"
#include "firmware/cortex_m.h"
#include "firmware/level.h"

extern "C" void edge_due();
extern "C" void time_over();

namespace sinew::firmware {

struct Wiring {
  const char* board;
  std::string (*pin)(std::uint32_t output);  // by its printed name; `outputs`: the supply's
  std::uint32_t outputs, inputs;
  bool (*drives)(std::uint32_t output);       // is its pin an output?
  bool (*has_current)(std::uint32_t output);  // would it have, if it were one? `outputs`: supply
  std::uint32_t (*converter_input)();         // that was selected last
  std::uint32_t (*input_of)(std::uint32_t input);
  std::uintptr_t count, compare;  // of the running timer
  std::uint32_t clocks_a_us;
  std::uint32_t edges, line, ticks;  // interrupts

  // Behaviour of the chip: a register with a side effect when it is written.
  void (*act)(std::uintptr_t address, std::uint32_t value);
  void (*power_on)();  // the worst case: latches of outputs would give current
};
extern const Wiring wiring;

}  // namespace sinew::firmware
