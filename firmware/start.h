// firmware/start.h - start-up that all boards share, and the table of interrupt vectors at the
// beginning of a program.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include "firmware/board.h"
#include "firmware/cortex_m.h"

namespace sinew::firmware {

// Starts the application. A chip that needs nothing else calls it first of all.
[[noreturn]] inline void start_application() {
  cortex_m::start_fpu();
  cortex_m::prepare_memory();
  cortex_m::paint_stack();
  run();
}

using Handler = void (*)();

// The processor's table, with N interrupts of the chip.
template <std::size_t N>
struct Vectors {
  std::uint32_t* stack;
  Handler exception[15];
  std::array<Handler, N> interrupt;
};

struct Interrupt {
  std::uint32_t number;
  Handler handler;
};

// Returns a table in which everything without a handler calls `fault`.
template <std::size_t N>
constexpr Vectors<N> vectors(Handler reset, Handler fault,
                             std::initializer_list<Interrupt> handlers = {}) {
  Vectors<N> out{stack_top, {}, {}};
  for (Handler& h : out.exception) h = fault;
  for (Handler& h : out.interrupt) h = fault;
  out.exception[0] = reset;
  for (const Interrupt& i : handlers) out.interrupt[i.number] = i.handler;
  return out;
}

}  // namespace sinew::firmware
