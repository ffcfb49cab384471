// firmware/boards/stm32f405/board.cpp - STM32F405RG, a Cortex-M4F at 168 MHz (ST RM0090, DS8626),
// as on small boards on the market. It has not been tested on a real board. It boots in
// qemu-system-arm's `netduinoplus2`, which has its serial line and timers but not its clocks, pins,
// watchdog and noise source (docs/how-to/hardware.md).
//
//   inputs 0 … 7      PA0 … PA7      the converter's inputs 0 … 7
//          8 … 13     PC0 … PC5                          10 … 15
//   outputs 0 … 11    PB4 … PB15     valves; each driver needs a resistor towards no current
//           12 … 15   PC6 … PC9
//   supply            PC12           the dump valve's coil
//   line              PA9 out, PA10 in
#include "firmware/board.h"

#include "firmware/cortex_m.h"
#include "firmware/start.h"
#include "firmware/timed_pins.h"

namespace sinew::firmware {
namespace {

using cortex_m::reg;
using signals::Status;
using signals::Tick;

constexpr std::uint32_t crystal = 8;  // [MHz]; other boards have 12 or 25
constexpr std::uint32_t timer_clock = 84'000'000, line_clock = 84'000'000;  // [Hz]
constexpr std::uint32_t clocks_a_tick = timer_clock / 10'000, clocks_a_us = timer_clock / 1'000'000;

// --- registers ----------------------------------------------------------------------------------

constexpr std::uintptr_t rcc = 0x40023800;
constexpr std::uintptr_t rcc_control = rcc, rcc_pll = rcc + 0x04, rcc_clocks = rcc + 0x08,
                         rcc_ahb1 = rcc + 0x30, rcc_ahb2 = rcc + 0x34, rcc_apb1 = rcc + 0x40,
                         rcc_apb2 = rcc + 0x44, rcc_why = rcc + 0x74;
constexpr std::uintptr_t flash_wait = 0x40023C00;
constexpr std::uintptr_t port_a = 0x40020000, port_b = 0x40020400, port_c = 0x40020800;
constexpr std::uintptr_t mode = 0x00, speed = 0x08, set_reset = 0x18, alternate_high = 0x24;
constexpr std::uintptr_t ticking = 0x40000000, running = 0x40000C00;  // TIM2, TIM5: 32 bits
constexpr std::uintptr_t timer_control = 0x00, timer_interrupts = 0x0C, timer_state = 0x10,
                         timer_events = 0x14, timer_count = 0x24, timer_prescaler = 0x28,
                         timer_reload = 0x2C, timer_compare = 0x34;
constexpr std::uintptr_t line = 0x40011000;  // USART1
constexpr std::uintptr_t line_state = line, line_data = line + 0x04, line_divider = line + 0x08,
                         line_control = line + 0x0C;
constexpr std::uintptr_t converter = 0x40012000;  // ADC1
constexpr std::uintptr_t converter_state = converter, converter_control = converter + 0x08,
                         converter_times_high = converter + 0x0C,
                         converter_times = converter + 0x10, converter_input = converter + 0x34,
                         converter_data = converter + 0x4C, converter_common = 0x40012304;
constexpr std::uintptr_t watchdog = 0x40003000;  // has a clock of its own
constexpr std::uintptr_t noise = 0x50060800;

constexpr std::uint32_t line_came = 1u << 5, line_room = 1u << 7, line_overrun = 1u << 3;
constexpr std::uint32_t line_on = 1u << 13 | 1u << 3 | 1u << 2 | line_came;
constexpr std::uint32_t conversion_done = 1u << 1, conversion_start = 1u << 30;

constexpr std::uint32_t compared = 1u << 1;  // bit of a timer's state and interrupts

constexpr std::uint32_t interrupt_of_ticks = 28, interrupt_of_line = 37, interrupt_of_edges = 50;

// --- memory that is kept over a reset -----------------------------------------------------------

struct Retained {
  std::uint32_t starts;
};
[[gnu::section(".kept")]] Retained retained;
bool reset_by_watchdog_ = false;

// Returns whether a bit was set within a limited time. The outputs of the valves are set up before
// the first call, so they are safe even if an oscillator does not start.
bool wait_for(std::uintptr_t address, std::uint32_t bits) {
  for (std::uint32_t i = 0; i < 100'000; ++i)
    if ((reg(address) & bits) == bits) return true;
  return false;
}

void set_mode(std::uintptr_t port, std::uint32_t pin, std::uint32_t to) {
  reg(port + mode) = (reg(port + mode) & ~(3u << 2 * pin)) | to << 2 * pin;
}
constexpr std::uint32_t output = 1, alternate = 2, analog = 3;

// --- pins ---------------------------------------------------------------------------------------

// Words for the set/reset registers: the upper half resets pins, the lower half sets them, so a
// port changes at once.
struct Pins {
  std::uint32_t b = 0, c = 0;  // 0: no change
};
constexpr Pins pins(std::uint32_t coils, bool supply) {
  const std::uint32_t b = (coils & 0xFFFu) << 4;
  const std::uint32_t c = (coils >> 12 & 0xFu) << 6 | (supply != low_gives_current ? 1u << 12 : 0);
  return {(~b & 0xFFF0u) << 16 | b, (~c & 0x13C0u) << 16 | c};
}
constexpr Pins no_current = pins(control::rest_word(low_gives_current), false);

void put(const Pins& p) {
  reg(port_b + set_reset) = p.b;
  reg(port_c + set_reset) = p.c;
}

constinit TimedPins<Pins, put,
                    CompareTimer{running + timer_count, running + timer_compare, clocks_a_us}>
    timed;

// Configures the pins. All coils are off before the pins become outputs.
void start_pins() {
  reg(rcc_ahb1) = reg(rcc_ahb1) | 7u;
  put(no_current);
  for (std::uint32_t pin = 4; pin < 16; ++pin) set_mode(port_b, pin, output);
  for (const std::uint32_t pin : {6u, 7u, 8u, 9u, 12u}) set_mode(port_c, pin, output);
  for (std::uint32_t pin = 0; pin < 8; ++pin) set_mode(port_a, pin, analog);
  for (std::uint32_t pin = 0; pin < 6; ++pin) set_mode(port_c, pin, analog);
  for (const std::uint32_t pin : {9u, 10u}) {
    set_mode(port_a, pin, alternate);
    reg(port_a + speed) = reg(port_a + speed) | 2u << 2 * pin;
    reg(port_a + alternate_high) = reg(port_a + alternate_high) | 7u << 4 * (pin - 8);
  }
}

// Sets 168 MHz from the crystal, or else from the oscillator on the chip, which may be 1 % off.
// Without the PLL a tick would have the wrong length, so the program waits here. The oscillator on
// the chip is on in all chips; it is off only in an emulator without these registers.
void start_clocks() {
  constexpr std::uint32_t crystal_on = 1u << 16, crystal_ready = 1u << 17, pll_on = 1u << 24,
                          pll_ready = 1u << 25, pll_by_crystal = 1u << 22, by_pll = 2;
  if (reg(rcc_control) == 0) return;
  reg(flash_wait) = 0x705;  // five wait states, caches on
  reg(rcc_control) = reg(rcc_control) | crystal_on;
  const bool has_crystal = wait_for(rcc_control, crystal_ready);
  const std::uint32_t divider = has_crystal ? crystal : 16;  // to 1 MHz; times 336, divided by 2
  reg(rcc_pll) = 7u << 24 | (has_crystal ? pll_by_crystal : 0) | 336u << 6 | divider;
  reg(rcc_control) = reg(rcc_control) | pll_on;
  while (!wait_for(rcc_control, pll_ready)) {}
  reg(rcc_clocks) = 4u << 13 | 5u << 10 | by_pll;  // APB2 84 MHz, APB1 42 MHz, its timers 84 MHz
}

void start_converter() {
  reg(converter_common) = 1u << 16;   // 84 MHz divided by 4
  reg(converter_times) = 0x1B6DB6DB;  // 56 clocks of sampling for each input, 3.2 us in all
  reg(converter_times_high) = 0x36DB6DB;
  reg(converter_control) = 1;
}

}  // namespace

// --- board.h ------------------------------------------------------------------------------------

namespace hardware {

void start() {
  constexpr std::uint32_t by_watchdog = 1u << 29, forget = 1u << 24;
  start_pins();
  reset_by_watchdog_ = reg(rcc_why) & by_watchdog;
  reg(rcc_why) = reg(rcc_why) | forget;
  ++retained.starts;
  start_clocks();
  reg(rcc_ahb2) = reg(rcc_ahb2) | 1u << 6;            // noise source
  reg(rcc_apb1) = reg(rcc_apb1) | 1u | 1u << 3;       // both timers
  reg(rcc_apb2) = reg(rcc_apb2) | 1u << 4 | 1u << 8;  // line and converter
  reg(noise) = 4;
  start_converter();
  reg(running + timer_reload) = 0xFFFFFFFF;
  reg(running + timer_events) = 1;
  reg(running + timer_state) = 0;
  reg(running + timer_interrupts) = compared;
  reg(running + timer_control) = 1;
}

const char* name() { return "stm32f405"; }
bool reset_by_watchdog() { return reset_by_watchdog_; }
bool active_low() { return low_gives_current; }

// Uses noise if available: after a time without power, memory kept by a battery may hold the same
// count.
std::uint32_t nonce() {
  const bool there = wait_for(noise + 4, 1);
  return (there ? reg(noise + 8) : 0) ^ (retained.starts << 16 | 1u);
}

void start_line(std::uint32_t baud) {
  reg(line_divider) = (line_clock + baud / 2) / baud;
  reg(line_control) = line_on;
  cortex_m::enable(interrupt_of_line, cortex_m::of_line);
}

// A USB adapter may hold bytes back for 16 ms.
std::uint32_t longest_pause() { return 200; }

// Starts the watchdog: 20 ms by a clock between 17 and 47 kHz, so 14 to 38 ms. The prescaler is 4.
void start_watchdog() {
  reg(watchdog) = 0xCCCC;
  reg(watchdog) = 0x5555;
  reg(watchdog + 0x04) = 0;
  reg(watchdog + 0x08) = 160;
  reg(watchdog) = 0xAAAA;
}
void feed_watchdog() { reg(watchdog) = 0xAAAA; }

void start_ticks() {
  timed.start();
  reg(ticking + timer_prescaler) = 0;
  reg(ticking + timer_reload) = clocks_a_tick - 1;
  reg(ticking + timer_interrupts) = 1;
  reg(ticking + timer_control) = 1;
  cortex_m::enable(interrupt_of_edges, cortex_m::of_edge);
  cortex_m::enable(interrupt_of_ticks, cortex_m::of_tick);
}

std::uint32_t ticks_passed() { return timed.ticks_passed(); }

void start_conversion(signals::Channel channel) {
  reg(converter_input) = channel.index < 8 ? channel.index : channel.index + 2u;
  reg(converter_state) = 0;
  reg(converter_control) = 1u | conversion_start;
}

signals::Reading reading(Tick) {
  if (!(reg(converter_state) & conversion_done)) return {0, Status::late};
  return {static_cast<std::uint16_t>(reg(converter_data)), Status::ok};
}

void drive(const Drive& d) { timed.drive(d, pins(coils_of(d), d.supply)); }

void block_ticks() { cortex_m::block_ticks(); }
void allow_ticks() { cortex_m::allow_ticks(); }
// The emulator's line has no interrupt for free room, so one is requested here.
void wake_sender() {
  reg(line_control) = line_on | line_room;
  cortex_m::request(interrupt_of_line);
}
void idle() { cortex_m::wait_for_interrupt(); }

}  // namespace hardware
}  // namespace sinew::firmware

// --- start-up and interrupts --------------------------------------------------------------------

extern "C" {

[[noreturn]] void reset() { sinew::firmware::start_application(); }

// Switches all coils off and waits for the watchdog's reset.
void fault() {
  using namespace sinew::firmware;
  cortex_m::block_interrupts();
  put(no_current);
  for (;;) {}
}

// A byte after an overrun belongs to a frame that its CRC rejects.
void line_works() {
  using namespace sinew::firmware;
  if (reg(line_state) & (line_came | line_overrun))
    received(static_cast<std::uint8_t>(reg(line_data)));
  if (!(reg(line_control) & line_room)) return;
  while (reg(line_state) & line_room) {
    std::uint8_t byte = 0;
    if (!next_to_send(byte)) {
      reg(line_control) = line_on;
      return;
    }
    reg(line_data) = byte;
  }
}

void time_over() {
  using namespace sinew::firmware;
  reg(ticking + timer_state) = 0;
  timed.put_late();
  tick();
}

void edge_due() {
  using namespace sinew::firmware;
  timed.put_due();
  reg(running + timer_state) = ~compared;
  cortex_m::wait_for_writes();
}

}  // extern "C"

namespace sinew::firmware {
[[gnu::section(".vectors"), gnu::used]] constinit const auto table =
    vectors<51>(reset, fault,
                {{interrupt_of_ticks, time_over},
                 {interrupt_of_line, line_works},
                 {interrupt_of_edges, edge_due}});
}
