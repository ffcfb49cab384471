// firmware/boards/teensy41/board.cpp - PJRC's Teensy 4.1: an i.MX RT1062, a Cortex-M7 (NXP i.MX
// RT1060 reference manual; ARMv7-M). It has not been tested on a real board, and the emulator does
// not support the chip (docs/reference/firmware.md lists what to check first). No pin may have more
// than 3.3 V.
//
//   inputs 0 … 9      pins 14 … 23            A0 … A9
//          10, 11     pins 24, 25             A10, A11
//          12, 13     pins 40, 41             A16, A17
//   outputs 0 … 6     pins 6 … 12             valves; each driver needs a resistor towards
//           7         pin 32                  no current, 10 kohm or less
//           8 … 11    pins 34 … 37
//           12 … 15   pins 2 … 5
//   supply            pin 33                  the dump valve's coil
//   line              pin 1 out, pin 0 in     LPUART6
//
// The core runs at the 396 MHz that the boot ROM sets, which is enough and avoids a source of
// errors. All timing uses the crystal of 24 MHz and is independent of the core's clock.
#include "firmware/board.h"

#include "firmware/cortex_m.h"
#include "firmware/timed_pins.h"

namespace sinew::firmware {
namespace {

using cortex_m::reg;
using signals::Status;
using signals::Tick;

constexpr std::uint32_t crystal = 24'000'000;  // [Hz]
constexpr std::uint32_t clocks_a_tick = crystal / 10'000, clocks_a_us = crystal / 1'000'000;

// --- registers ----------------------------------------------------------------------------------

// CCM: sources and gates of clocks. A gate has two bits for each device, 3 is on.
constexpr std::uintptr_t ccm = 0x400FC000;
constexpr std::uintptr_t clock_of_timers = ccm + 0x1C, clock_of_line = ccm + 0x24,
                         gate_1 = ccm + 0x6C, gate_3 = ccm + 0x74, gate_5 = ccm + 0x7C,
                         gate_6 = ccm + 0x80;

// IOMUXC: use of a pad (mux) and its resistors (pad). Its normal ports are on the slow bus; GPR
// connects their pins to fast ports: 1 becomes 6, 2 becomes 7, 4 becomes 9.
constexpr std::uintptr_t iomux = 0x401F8000, gpr = 0x400AC000;
constexpr std::uintptr_t mux_of_port_1 = iomux + 0x0BC, mux_of_port_2 = iomux + 0x13C,
                         mux_of_port_4 = iomux + 0x014;  // 4 bytes for each bit of the port
constexpr std::uintptr_t from_mux_to_pad = 0x1F0, pad_of_received = iomux + 0x550;
constexpr std::uintptr_t port_2_is_7 = gpr + 0x6C, port_4_is_9 = gpr + 0x74;
constexpr std::uintptr_t port_7 = 0x42004000, port_9 = 0x4200C000;
constexpr std::uintptr_t port_data = 0x00, port_directions = 0x04;

constexpr std::uintptr_t ticking = 0x40084000;  // PIT: counts down and reloads
constexpr std::uintptr_t ticking_off = ticking, ticking_reload = ticking + 0x100,
                         ticking_control = ticking + 0x108, ticking_state = ticking + 0x10C;
constexpr std::uintptr_t running = 0x401EC000;  // GPT1: 32 bits, free-running
constexpr std::uintptr_t running_control = running, running_prescaler = running + 0x04,
                         running_state = running + 0x08, running_interrupts = running + 0x0C,
                         running_compare = running + 0x10, running_count = running + 0x24;
constexpr std::uintptr_t line = 0x40198000;  // LPUART6
constexpr std::uintptr_t line_divider = line + 0x10, line_state = line + 0x14,
                         line_control = line + 0x18, line_data = line + 0x1C,
                         line_queues = line + 0x28, line_marks = line + 0x2C;
constexpr std::uintptr_t converter = 0x400C4000;  // ADC1
constexpr std::uintptr_t converter_start = converter, converter_state = converter + 0x20,
                         converter_data = converter + 0x24, converter_mode = converter + 0x44,
                         converter_control = converter + 0x48;
constexpr std::uintptr_t watchdog = 0x400BC000;  // RTWDOG, the third watchdog
constexpr std::uintptr_t watchdog_control = watchdog, watchdog_key = watchdog + 0x04,
                         watchdog_time = watchdog + 0x08, watchdog_window = watchdog + 0x0C;
constexpr std::uintptr_t noise = 0x400CC000;  // TRNG
constexpr std::uintptr_t why_reset = 0x400F8008;

constexpr std::uint32_t line_came = 1u << 21, line_room = 1u << 23, line_errors = 0xFu << 16;
constexpr std::uint32_t line_on = 1u << 27 | 1u << 21 | 1u << 19 | 1u << 18;  // overrun, in, out
constexpr std::uint32_t compared = 1;  // bit of the running timer's state and interrupts
constexpr std::uint32_t interrupt_of_line = 25, interrupt_of_edges = 100, interrupt_of_ticks = 122;

// --- pins ---------------------------------------------------------------------------------------

// Bits in its port of each output and input. Input i is the converter's (bit - 11) modulo 16.
constexpr std::uint8_t output_0_of_7[] = {10, 17, 16, 11, 0, 2, 1, 12, 29, 28, 18, 19};
constexpr std::uint8_t output_12_of_9[] = {4, 5, 6, 8};
constexpr std::uint32_t supply_of_9 = 1u << 7;
constexpr std::uint8_t input_of_1[] = {18, 19, 23, 22, 17, 16, 26, 27, 24, 25, 12, 13, 20, 21};

struct Pins {
  std::uint32_t of_7 = 0, of_9 = 0;
};
constexpr Pins pins(std::uint32_t coils, bool supply) {
  Pins out;
  for (const std::uint8_t bit : output_0_of_7) out.of_7 |= (coils & 1u) << bit, coils >>= 1;
  for (const std::uint8_t bit : output_12_of_9) out.of_9 |= (coils & 1u) << bit, coils >>= 1;
  if (supply != low_gives_current) out.of_9 |= supply_of_9;
  return out;
}
constexpr Pins all = pins(~0u, !low_gives_current);
constexpr Pins no_current = pins(control::rest_word(low_gives_current), false);

// Writes all pins of both ports: the ports have no other outputs, so each changes at once.
void put(const Pins& p) {
  reg(port_7 + port_data) = p.of_7;
  reg(port_9 + port_data) = p.of_9;
}

constinit TimedPins<Pins, put, CompareTimer{running_count, running_compare, clocks_a_us}> timed;

void set_pad(std::uintptr_t mux, std::uint32_t for_what, std::uint32_t resistors) {
  reg(mux) = for_what;
  reg(mux + from_mux_to_pad) = resistors;
}

// Configures the pins. All coils are off before the pins become outputs. After a reset a pad keeps
// its last level weakly until then, so the driver's resistor determines the level.
void start_pins() {
  constexpr std::uint32_t port = 5, towards_no_current = low_gives_current ? 0xF0B0 : 0x30B0,
                          nothing_pulls = 0x00B0;
  put(no_current);
  reg(port_2_is_7) = ~0u;
  reg(port_4_is_9) = ~0u;
  put(no_current);
  for (const std::uint8_t bit : output_0_of_7)
    set_pad(mux_of_port_2 + 4u * bit, port, towards_no_current);
  for (std::uint32_t bit = 4; bit <= 8; ++bit)
    set_pad(mux_of_port_4 + 4 * bit, port, towards_no_current);
  reg(port_7 + port_directions) = reg(port_7 + port_directions) | all.of_7;
  reg(port_9 + port_directions) = reg(port_9 + port_directions) | all.of_9;
  for (const std::uint8_t bit : input_of_1) set_pad(mux_of_port_1 + 4u * bit, port, nothing_pulls);
}

// --- memory that is kept over a reset -----------------------------------------------------------

struct Retained {
  std::uint32_t starts;
};
[[gnu::section(".kept")]] Retained retained;
bool reset_by_watchdog_ = false;

// Waits for a bit for about 0.2 s. Returns false if it did not change.
bool wait_for(std::uintptr_t address, std::uint32_t bits, std::uint32_t value) {
  for (std::uint32_t i = 0; i < 2'000'000; ++i)
    if ((reg(address) & bits) == value) return true;
  return false;
}

// Connects timers and line to the undivided crystal, then enables each device's clock.
void start_clocks() {
  constexpr std::uint32_t by_crystal = 1u << 6, divider = 0x3F;
  reg(clock_of_timers) = (reg(clock_of_timers) & ~divider) | by_crystal;
  reg(clock_of_line) = (reg(clock_of_line) & ~divider) | by_crystal;
  reg(gate_1) = reg(gate_1) | 0xFu << 20 | 3u << 16 | 3u << 12;  // GPT1, ADC1, PIT
  reg(gate_3) = reg(gate_3) | 3u << 6;                           // LPUART6
  reg(gate_5) = reg(gate_5) | 3u << 4;                           // RTWDOG
  reg(gate_6) = reg(gate_6) | 3u << 12;                          // TRNG
}

// Sets up the converter: 12 bits, its own clock of 10 MHz, 24 clocks of sampling and 25 of
// conversion: 5 us. It calibrates itself once.
void start_converter() {
  constexpr std::uint32_t calibrating = 1u << 7;
  reg(converter_mode) = 1u << 10 | 3u << 8 | 1u << 5 | 1u << 4 | 2u << 2 | 3u;
  reg(converter_control) = calibrating;
  wait_for(converter_control, calibrating, 0);
}

}  // namespace

// --- board.h ------------------------------------------------------------------------------------

namespace hardware {

namespace {
std::uint32_t ticks_since_feeding = 0;  // calls since the watchdog was fed
}  // namespace

void start() {
  constexpr std::uint32_t by_watchdog = 1u << 7;
  start_pins();
  reset_by_watchdog_ = reg(why_reset) & by_watchdog;
  reg(why_reset) = reg(why_reset);  // writing a one clears the flag
  ++retained.starts;
  start_clocks();
  reg(noise) = 1u << 16 | 1u << 6;  // stopped with its defaults; then started
  reg(noise) = 2;
  [[maybe_unused]] const std::uint32_t last = reg(noise + 0x7C);  // starts a new generation
  start_converter();
  reg(running_control) = 0;
  reg(running_prescaler) = 0;
  reg(running_interrupts) = compared;
  reg(running_state) = 0x3F;
  reg(running_control) = 1u << 9 | 1u << 6 | 1u << 2 | 1u << 1 | 1u;  // free-running
}

const char* name() { return "teensy41"; }
bool reset_by_watchdog() { return reset_by_watchdog_; }
bool active_low() { return low_gives_current; }

// Uses noise if the source delivers some within a tenth of a second.
std::uint32_t nonce() {
  constexpr std::uint32_t there = 1u << 10;
  return (wait_for(noise, there, there) ? reg(noise + 0x40) : 0) ^ (retained.starts << 16 | 1u);
}

// Each bit is sampled as often as the crystal has clocks in it: 26 at 921,600 baud, which makes
// 923,077. Both directions have a queue of four bytes.
void start_line(std::uint32_t baud) {
  const std::uint32_t samples = (crystal + baud / 2) / baud;  // 9 … 32
  set_pad(mux_of_port_1 + 4 * 2, 2, 0x00D9);
  set_pad(mux_of_port_1 + 4 * 3, 2, 0x1F038);  // pulled up, so that an unconnected pin is silent
  reg(pad_of_received) = 1;
  reg(line_control) = 0;
  reg(line_divider) = (samples - 1) << 24 | 1;
  reg(line_queues) = 1u << 15 | 1u << 14 | 1u << 7 | 1u << 3;
  reg(line_marks) = 2;  // interrupt at the first received byte, and when two are left to send
  reg(line_control) = line_on;
  cortex_m::enable(interrupt_of_line, cortex_m::of_line);
}

// A USB adapter may hold bytes back for 16 ms.
std::uint32_t longest_pause() { return 200; }

// Starts the watchdog: 20 ms by the crystal of 32,768 Hz. Its registers can be written for 128
// clocks of the bus after the key. It runs in debug, wait and stop modes, and cannot be changed
// again.
void start_watchdog() {
  constexpr std::uint32_t key = 0xD928C520, wide = 1u << 13, taken = 1u << 10;
  cortex_m::block_interrupts();
  if (reg(watchdog_control) & wide) {
    reg(watchdog_key) = key;
  } else {
    cortex_m::half_reg(watchdog_key) = key & 0xFFFF;
    cortex_m::half_reg(watchdog_key) = key >> 16;
  }
  reg(watchdog_window) = 0;
  reg(watchdog_time) = 655;
  reg(watchdog_control) = wide | 1u << 8 | 1u << 7 | 7u;
  cortex_m::allow_interrupts();
  wait_for(watchdog_control, taken, taken);
}

// Feeds the watchdog once a millisecond, since its clock is slower than the ticks.
void feed_watchdog() {
  if (++ticks_since_feeding < 10) return;
  ticks_since_feeding = 0;
  reg(watchdog_key) = 0xB480A602;
}

void start_ticks() {
  timed.start();
  reg(ticking_off) = 0;
  reg(ticking_reload) = clocks_a_tick - 1;
  reg(ticking_state) = 1;
  reg(ticking_control) = 3;
  cortex_m::enable(interrupt_of_edges, cortex_m::of_edge);
  cortex_m::enable(interrupt_of_ticks, cortex_m::of_tick);
}

std::uint32_t ticks_passed() { return timed.ticks_passed(); }

void start_conversion(signals::Channel channel) {
  reg(converter_start) = (input_of_1[channel.index] + 5u) % 16;
}

signals::Reading reading(Tick) {
  if (!(reg(converter_state) & 1u)) return {0, Status::late};
  return {static_cast<std::uint16_t>(reg(converter_data)), Status::ok};
}

void drive(const Drive& d) { timed.drive(d, pins(coils_of(d), d.supply)); }

void block_ticks() { cortex_m::block_ticks(); }
void allow_ticks() { cortex_m::allow_ticks(); }

void wake_sender() { reg(line_control) = line_on | line_room; }

// Does not sleep: by default the chip would stop clocks that are in use, and waking up takes time.
void idle() {}

}  // namespace hardware
}  // namespace sinew::firmware

// --- interrupts ---------------------------------------------------------------------------------

extern "C" {

// Switches all coils off and waits for the watchdog's reset.
void fault() {
  using namespace sinew::firmware;
  cortex_m::block_interrupts();
  put(no_current);
  for (;;) {}
}

// An overrun stops the line until its flag is cleared; the CRC rejects the frame.
void line_works() {
  using namespace sinew::firmware;
  while (reg(line_state) & line_came) received(static_cast<std::uint8_t>(reg(line_data)));
  reg(line_state) = line_errors;
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
  reg(ticking_state) = 1;
  timed.put_late();
  tick();
}

// The request must be cleared before the return, or this processor enters the interrupt again.
void edge_due() {
  using namespace sinew::firmware;
  timed.put_due();
  reg(running_state) = compared;
  cortex_m::wait_for_writes();
}

}  // extern "C"
