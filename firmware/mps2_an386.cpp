// firmware/mps2_an386.cpp - start-up, output and end of the self-test on QEMU's Cortex-M4F board.
//
// Output and end go through semihosting: the processor stops at BKPT 0xAB, the emulator does what
// r0 asks for with the parameter r1.
#include <cstdint>

extern "C" {
extern std::uint8_t stack_top[];  // from the linker script
[[noreturn]] void reset();
[[noreturn]] void fault();
}

namespace sinew::firmware {
void same_bits();

namespace {

constexpr std::uint32_t write0 = 0x04;         // SYS_WRITE0: a text that ends with 0
constexpr std::uint32_t exit_extended = 0x20;  // SYS_EXIT_EXTENDED: reason and code

void semihost(std::uint32_t operation, const void* parameter) {
  register std::uint32_t r0 asm("r0") = operation;
  register const void* r1 asm("r1") = parameter;
  asm volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
}

[[noreturn]] void quit(std::uint32_t code) {
  constexpr std::uint32_t application_exit = 0x20026;
  const std::uint32_t block[] = {application_exit, code};
  semihost(exit_extended, block);
  for (;;) {}
}

}  // namespace

void print(const char* text) { semihost(write0, text); }

}  // namespace sinew::firmware

extern "C" {

void reset() {
  // Full access to the FPU (coprocessors 10 and 11), which is off after reset.
  constexpr std::uintptr_t coprocessor_access_control = 0xE000ED88;
  *reinterpret_cast<volatile std::uint32_t*>(coprocessor_access_control) |= 0xFu << 20;
  asm volatile("dsb\n isb" ::: "memory");

  sinew::firmware::same_bits();
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
