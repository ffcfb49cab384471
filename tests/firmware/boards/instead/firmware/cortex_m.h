// In place of firmware/cortex_m.h: registers are entries of a map, and a test receives all writes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>

extern "C" {
extern std::uint32_t stack_top[];
}

namespace sinew::firmware::cortex_m {

struct Registers {
  std::map<std::uintptr_t, std::uint32_t> value;
  std::function<void(std::uintptr_t, std::uint32_t)> on_write;
  std::map<std::uint32_t, std::uint8_t> priority;  // of enabled interrupts
};
Registers& registers();

// Read and written as a number, like the reg(…) of a board.
class Register {
 public:
  explicit Register(std::uintptr_t address) : address_(address) {}
  operator std::uint32_t() const { return registers().value[address_]; }
  Register& operator=(std::uint32_t value) {
    registers().value[address_] = value;
    if (registers().on_write) registers().on_write(address_, value);
    return *this;
  }
  Register& operator=(const Register& other) { return *this = std::uint32_t{other}; }

 private:
  std::uintptr_t address_;
};
inline Register reg(std::uintptr_t address) { return Register(address); }
inline Register half_reg(std::uintptr_t address) { return Register(address); }

inline constexpr std::uint8_t of_edge = 0x20, of_line = 0x40, of_tick = 0x80;
inline void enable(std::uint32_t interrupt, std::uint8_t priority) {
  registers().priority[interrupt] = priority;
}
inline void request(std::uint32_t) {}

inline void block_ticks() {}
inline void allow_ticks() {}
inline void block_interrupts() {}
inline void allow_interrupts() {}
inline void wait_for_writes() {}
inline void wait_for_interrupt() {}
inline void start_fpu() {}
inline void prepare_memory() {}
inline void paint_stack() {}

}  // namespace sinew::firmware::cortex_m
