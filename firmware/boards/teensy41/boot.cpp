// firmware/boards/teensy41/boot.cpp - start-up until run(): data in the flash chip for the
// processor's boot ROM, the first instructions, memory, and the interrupt vectors.
//
//   0x60000000   how to read the chip: 512 bytes that begin with FCFB
//   0x60001000   place of the program and its first instruction
//
// Sources: i.MX RT1060 reference manual, chapter 9, system boot; numbers of the flash chip and of
// the memory banks as every Teensy 4.1 starts with them (PJRC's core library, bootdata.c and
// startup.c).
#include <array>
#include <cstdint>

#include "firmware/board.h"
#include "firmware/cortex_m.h"
#include "firmware/start.h"

extern "C" {
// Symbols of the linker script: the addresses of the program in memory and in the chip, and the
// part of the chip that it uses.
extern std::uint32_t code_begin[], code_end[], code_from[], image_size[];

[[noreturn]] void first();
[[noreturn]] void reset();
void fault();
void line_works();
void time_over();
void edge_due();
}

namespace sinew::firmware {
namespace {

using cortex_m::reg;

// --- the flash chip, a Winbond W25Q64JV of 8 MB on four wires ------------------------------------

constexpr std::uint32_t command = 1, address = 2, mode = 7, write = 8, read = 9, pause = 12,
                        again = 31;         // instructions of a sequence
constexpr std::uint32_t one = 0, four = 2;  // number of wires, encoded
constexpr std::uint32_t step(std::uint32_t what, std::uint32_t wires, std::uint32_t with) {
  return what << 10 | wires << 8 | with;
}

// Each command of the chip is a sequence of up to eight instructions, two per word.
constexpr std::uint32_t two(std::uint32_t a, std::uint32_t b = 0) { return b << 16 | a; }

constexpr std::array<std::uint32_t, 128> flash_chip() {
  std::array<std::uint32_t, 128> w{};  // index: byte offset in the block, divided by 4
  w[0x000 / 4] = 0x42464346;           // "FCFB"
  w[0x004 / 4] = 0x56010000;           // version
  w[0x00C / 4] = 0x00030301;           // 3 clocks of hold, 3 of set-up; sample clock looped back
  w[0x044 / 4] = 0x00080401;           // 133 MHz, four wires, NOR
  w[0x050 / 4] = 8u << 20;             // size in bytes
  const auto sequence = [&](std::size_t number) { return &w[0x080 / 4 + 4 * number]; };
  std::uint32_t* to = sequence(0);  // read; the chip stays in this command, `again` omits it
  to[0] = two(step(command, one, 0xEB), step(address, four, 24));
  to[1] = two(step(mode, four, 0x20), step(pause, four, 4));
  to[2] = two(step(read, four, 4), step(again, one, 1));
  sequence(1)[0] = two(step(command, one, 0x05), step(read, one, 4));      // read the status
  sequence(3)[0] = two(step(command, one, 0x06));                          // enable writing
  sequence(5)[0] = two(step(command, one, 0x20), step(address, one, 24));  // erase 4 KB
  sequence(8)[0] = two(step(command, one, 0xD8), step(address, one, 24));  // erase 64 KB
  sequence(9)[0] = two(step(command, one, 0x02), step(address, one, 24));  // write a page
  sequence(9)[1] = two(step(write, one, 4));
  sequence(11)[0] = two(step(command, one, 0x60));  // erase the chip
  w[0x1C0 / 4] = 256;                               // page size [bytes]
  w[0x1C4 / 4] = 4'096;                             // sector size [bytes]
  w[0x1C8 / 4] = 1;                                 // 30 MHz for commands
  w[0x1D0 / 4] = 64u << 10;                         // block size [bytes]
  return w;
}
static_assert(flash_chip()[0x080 / 4] == 0x0A1804EB && flash_chip()[0x084 / 4] == 0x32041E20 &&
              flash_chip()[0x088 / 4] == 0x7C012604);
[[gnu::section(".boot.flash"), gnu::used]] constinit const auto flash_block = flash_chip();

// --- the program --------------------------------------------------------------------------------

struct Image {
  std::uint32_t header;  // 0xD1, 32 bytes, version 4.3
  void (*entry)();
  std::uint32_t nothing, no_commands_for_clocks_and_memory;
  const void* extent;
  const void* itself;
  std::uint32_t no_signature, nothing_more;
  const void* begin;  // extent of the image in the chip
  const void* size;
  std::uint32_t no_plugin;
};
const std::uintptr_t chip = 0x60000000;
[[gnu::section(".boot.image"), gnu::used]] const Image image = {
    0x432000D1, first, 0, 0, &image.begin, &image, 0, 0, reinterpret_cast<const void*>(chip),
    image_size, 0};

// --- memory -------------------------------------------------------------------------------------

constexpr std::uintptr_t gpr = 0x400AC000;  // IOMUXC_GPR: general settings of the chip
constexpr std::uintptr_t tcm_sizes = gpr + 0x38, tcm_on = gpr + 0x40, banks = gpr + 0x44;

// The processor may read ahead at addresses without memory. The MPU therefore forbids all addresses
// and then permits those in use; a later region overrides an earlier one.
struct Region {
  std::uint32_t begin, log2_size, may;
};
constexpr std::uint32_t no_code = 1u << 28, nobody = 0, to_read = 7u << 24, to_write = 3u << 24,
                        memory = 1u << 19, device = 2u << 19;
constexpr Region regions[] = {
    {0x00000000, 32, nobody | no_code},
    {0x00000000, 17, memory | to_read},             // code
    {0x20000000, 19, memory | to_write | no_code},  // data
    {0x40000000, 26, device | to_write | no_code},  // registers
    {0x60000000, 23, memory | to_read | no_code},   // flash chip, source of the data
};

void protect_memory() {
  constexpr std::uintptr_t control = 0xE000ED94, base = 0xE000ED9C, attributes = 0xE000EDA0;
  constexpr std::uint32_t valid = 1u << 4, on = 1;
  reg(control) = 0;
  std::uint32_t number = 0;
  for (const Region& r : regions) {
    reg(base) = r.begin | valid | number++;
    reg(attributes) = r.may | (r.log2_size - 1) << 1 | on;
  }
  reg(control) = on;
  asm volatile("dsb\n isb" ::: "memory");
}

// --- interrupts ---------------------------------------------------------------------------------

[[gnu::section(".vectors"), gnu::used]] constinit const auto table = vectors<160>(
    reset, fault, {{25, line_works}, {100, edge_due}, {122, time_over}});  // LPUART6, GPT1, PIT

}  // namespace
}  // namespace sinew::firmware

extern "C" {

// Runs in the flash chip on the ROM's stack. No other code is in memory yet, so it calls no
// functions. Of the 16 banks of RAM 4 are set up for code and 12 for data. The copy uses `volatile`
// so that the compiler does not call memcpy for it.
[[noreturn, gnu::section(".boot.first")]] void first() {
  using namespace sinew::firmware;
  reg(banks) = 0xAAAAAAFF;      // two bits per bank: 3 is code, 2 data
  reg(tcm_on) = 0x00200007;     // use `banks`, not the fuses
  reg(tcm_sizes) = 0x00AA0000;  // largest sizes
  asm volatile("dsb\n isb" ::: "memory");
  for (int i = 0; i < 100; ++i) asm volatile("nop");  // some boards need this delay
  const volatile std::uint32_t* from = code_from;
  for (volatile std::uint32_t* to = code_begin; to < code_end; ++to) *to = *from++;
  asm volatile("dsb\n isb\n mov sp, %0\n bx %1" ::"r"(stack_top), "r"(reset) : "memory");
  __builtin_unreachable();
}

// Runs in the tightly coupled memory. The ROM may have left its system timer and interrupts
// enabled.
[[noreturn]] void reset() {
  using namespace sinew::firmware;
  reg(0xE000ED08) = reinterpret_cast<std::uintptr_t>(&table);
  reg(0xE000E010) = 0;
  for (std::uintptr_t word = 0; word < 5; ++word) {
    reg(0xE000E180 + 4 * word) = ~0u;  // disabled
    reg(0xE000E280 + 4 * word) = ~0u;  // not pending
  }
  cortex_m::start_fpu();
  protect_memory();
  start_application();
}

}  // extern "C"
