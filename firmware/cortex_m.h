// firmware/cortex_m.h - functions common to Cortex-M4 and M7 processors: interrupts with
// priorities, an FPU that is off after a reset, measurement of the stack.
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" {
// Symbols of the linker script.
extern std::uint32_t stack_top[], stack_limit[];
extern std::uint32_t bss_begin[], bss_end[], data_begin[], data_end[], data_from[];
}

namespace sinew::firmware::cortex_m {

inline volatile std::uint32_t& reg(std::uintptr_t address) {
  return *reinterpret_cast<volatile std::uint32_t*>(address);
}

inline volatile std::uint16_t& half_reg(std::uintptr_t address) {
  return *reinterpret_cast<volatile std::uint16_t*>(address);
}

// Priorities; a lower number is more urgent. Every board has four bits of them.
inline constexpr std::uint8_t of_edge = 0x20, of_line = 0x40, of_tick = 0x80;

inline void enable(std::uint32_t interrupt, std::uint8_t priority) {
  *reinterpret_cast<volatile std::uint8_t*>(0xE000E400 + interrupt) = priority;
  reg(0xE000E100 + 4 * (interrupt / 32)) = 1u << interrupt % 32;
}
inline void request(std::uint32_t interrupt) {
  reg(0xE000E200 + 4 * (interrupt / 32)) = 1u << interrupt % 32;
}

// Blocks interrupts of the tick's priority; those of the line stay enabled.
inline void block_ticks() { asm volatile("msr basepri, %0" ::"r"(of_tick) : "memory"); }
inline void allow_ticks() { asm volatile("msr basepri, %0" ::"r"(0) : "memory"); }

// Block all interrupts except faults, and enable them.
inline void block_interrupts() { asm volatile("cpsid i" ::: "memory"); }
inline void allow_interrupts() { asm volatile("cpsie i" ::: "memory"); }

// Waits until writes have arrived. Without it, an interrupt whose request is cleared last may be
// raised again.
inline void wait_for_writes() { asm volatile("dsb" ::: "memory"); }

inline void wait_for_interrupt() { asm volatile("dsb\n wfi" ::: "memory"); }

[[noreturn]] inline void reset_all() {
  asm volatile("dsb" ::: "memory");
  reg(0xE000ED0C) = 0x05FA0004;
  for (;;) {}
}

// Full access to the FPU (coprocessors 10 and 11).
inline void start_fpu() {
  reg(0xE000ED88) = reg(0xE000ED88) | 0xFu << 20;
  asm volatile("dsb\n isb" ::: "memory");
}

// Initialises variables: copies .data and clears .bss.
inline void prepare_memory() {
  const volatile std::uint32_t* from = data_from;
  for (volatile std::uint32_t* p = data_begin; p < data_end; ++p) *p = *from++;
  for (volatile std::uint32_t* p = bss_begin; p < bss_end; ++p) *p = 0;
}

// --- the stack ----------------------------------------------------------------------------------

inline constexpr std::uint32_t untouched = 0xdeadbeef;

// Fills the stack with a pattern, before any interrupt. `kept` bytes of the caller's own stack are
// left.
inline void paint_stack() {
  constexpr std::uintptr_t kept = 64 * 4;
  const std::uintptr_t end = reinterpret_cast<std::uintptr_t>(stack_top) - kept;
  for (auto at = reinterpret_cast<std::uintptr_t>(stack_limit); at < end; at += 4)
    reg(at) = untouched;
}

// Returns the largest depth of the stack so far [bytes].
inline std::uint32_t deepest_stack() {
  auto at = reinterpret_cast<std::uintptr_t>(stack_limit);
  while (reg(at) == untouched) at += 4;
  return reinterpret_cast<std::uintptr_t>(stack_top) - at;
}

}  // namespace sinew::firmware::cortex_m
