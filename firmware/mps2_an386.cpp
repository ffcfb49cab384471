// firmware/mps2_an386.cpp - start-up and exit of a program on QEMU's Cortex-M4F board.
#include <cstddef>
#include <cstdint>

#include "firmware/semihosting.h"

extern "C" {
extern std::uint8_t stack_top[], stack_limit[];  // from the linker script
[[noreturn]] void reset();
[[noreturn]] void fault();
}

namespace sinew::firmware {

void program();  // defined by the image

namespace {

constexpr std::uint32_t untouched = 0xdeadbeef;

// Returns the i-th word from the stack's limit, where its unused part is.
std::uint32_t* stack_word(std::size_t i) {
  return reinterpret_cast<std::uint32_t*>(stack_limit) + i;
}
constexpr std::size_t kept = 64;  // words of this function's own stack that must not be overwritten

void paint_stack() {
  const auto words = static_cast<std::size_t>(stack_top - stack_limit) / 4;
  for (std::size_t i = 0; i + kept < words; ++i) *stack_word(i) = untouched;
}

}  // namespace

// Returns the largest depth of the stack so far [bytes].
std::uint32_t deepest_stack() {
  std::size_t i = 0;
  while (*stack_word(i) == untouched) ++i;
  return static_cast<std::uint32_t>(stack_top - stack_limit) - static_cast<std::uint32_t>(4 * i);
}

}  // namespace sinew::firmware

extern "C" {

void reset() {
  // Full access to the FPU (coprocessors 10 and 11), which is off after reset.
  constexpr std::uintptr_t coprocessor_access_control = 0xE000ED88;
  *reinterpret_cast<volatile std::uint32_t*>(coprocessor_access_control) |= 0xFu << 20;
  asm volatile("dsb\n isb" ::: "memory");

  sinew::firmware::paint_stack();
  sinew::firmware::program();
  sinew::firmware::quit(0);
}

void fault() {
  sinew::firmware::print("fault\n");
  sinew::firmware::quit(1);
}

using Handler = void (*)();
[[gnu::section(".vectors"), gnu::used]] const struct {
  std::uint8_t* stack;
  Handler handler[15];
} vectors = {stack_top,
             {reset, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault,
              fault, fault, fault}};

}  // extern "C"
