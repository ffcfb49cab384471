// firmware/boards/mps2_an386/board.cpp - Arm's MPS2 with image AN386, a Cortex-M4F at 25 MHz, as
// emulated by qemu-system-arm: UART, timers and watchdog are the board's own (Cortex-M System
// Design Kit, ARM DDI 0479). Converter and valves are the host's, by the records V and R of
// sinew/control/board/lock_step.h, if the emulator is started with the names of two pipes.
// Otherwise readings are the middle of the scale and the valves have no effect.
//
//   -semihosting-config enable=on,target=native,arg=board[,arg=TO,arg=FROM]
//
// The word `starve` in place of the pipes stops the feeding of the watchdog after a second.
#include "firmware/board.h"

#include <array>

#include "firmware/cortex_m.h"
#include "firmware/host_pipes.h"
#include "firmware/level.h"
#include "firmware/start.h"
#include "firmware/tick_count.h"

namespace sinew::firmware {
namespace {

using cortex_m::reg;
using signals::Status;
using signals::Tick;

constexpr std::uint32_t clock = 25'000'000;  // [Hz]
constexpr std::uint32_t clocks_a_tick = clock / 10'000;

// --- registers ----------------------------------------------------------------------------------

// Two timers that count down: one for the ticks, and a free-running one to count missed ticks.
constexpr std::uintptr_t ticking = 0x40000000, running = 0x40001000;
constexpr std::uintptr_t control = 0x0, value = 0x4, reload = 0x8, interrupt = 0xC;
constexpr std::uint32_t enabled = 1, interrupts = 8;

constexpr std::uintptr_t uart = 0x40004000;
constexpr std::uintptr_t uart_data = uart, uart_state = uart + 0x4, uart_control = uart + 0x8,
                         uart_interrupt = uart + 0xC, uart_divider = uart + 0x10;
constexpr std::uint32_t full_to_send = 1, full_of_received = 2;  // bits of its state
constexpr std::uint32_t sent = 1, has_come = 2;                  // bits of its interrupts
constexpr std::uint32_t both_ways_with_interrupts = 0xF;

// The watchdog interrupts when its time is over, and resets the second time if it is not fed
// before.
constexpr std::uintptr_t watchdog = 0x40008000;
constexpr std::uintptr_t watchdog_load = watchdog, watchdog_control = watchdog + 0x8,
                         watchdog_clear = watchdog + 0xC, watchdog_lock = watchdog + 0xC00;
constexpr std::uint32_t interrupt_and_reset = 3, unlocked = 0x1ACCE551;

constexpr std::uint32_t line_came = 0, line_sent = 1, time_is_over = 8;  // interrupt numbers

// --- memory that is kept over a reset -----------------------------------------------------------

constexpr std::uint32_t watchdog_expired = 0x62697465;

struct Retained {
  std::uint32_t why, starts;
};
[[gnu::section(".kept")]] Retained retained;

// --- the host's converter and valves ------------------------------------------------------------

Room<Host> host_room;
Host* host = nullptr;

// The emulator's UART sends a byte in no time, so bytes are limited to those of a line of 921,600
// baud: nine per tick.
constexpr std::uint32_t bytes_a_tick = 9;
std::uint32_t bytes_left = 0;

bool reset_by_watchdog_ = false;
bool stops_feeding = false;
std::uint32_t feedings = 0;

bool same(const char* a, const char* b) {
  while (*a != 0 && *a == *b) ++a, ++b;
  return *a == *b;
}

// Reads the words after the program's name.
void read_command_line() {
  std::array<const char*, 3> word{};
  const std::size_t n = command_words(word);
  stops_feeding = n == 2 && same(word[1], "starve");
  if (n == 3) host = &host_room.make(word[1], word[2]);
}

// --- the stack, once a second -------------------------------------------------------------------

std::uint32_t deepest = 0, last_look = 0;

void look_at_stack() {
  const std::uint32_t now = reg(running + value);
  if (last_look - now < clock) return;
  last_look = now;
  if (cortex_m::deepest_stack() == deepest) return;
  deepest = cortex_m::deepest_stack();
  print_number("deepest stack ", deepest);
  print("\n");
}

}  // namespace

// --- board.h ------------------------------------------------------------------------------------

namespace hardware {

namespace {
constinit TickCount count;
std::uint32_t clocks() { return ~reg(running + value); }  // increasing

signals::Channel converted;

// Waits in the tick's interrupt: only the line's interrupts run meanwhile.
void stand_still(std::uint32_t ticks) {
  const std::uint32_t since = clocks();
  while (clocks() - since < ticks * clocks_a_tick) {}
}
}  // namespace

void start() {
  asm volatile("" : : "r"(board::application_image));  // keeps the mark in the image
  reset_by_watchdog_ = retained.why == watchdog_expired;
  retained.why = 0;
  ++retained.starts;
  read_command_line();
  reg(running + reload) = 0xFFFFFFFF;
  reg(running + control) = enabled;
}

const char* name() { return "mps2-an386"; }
bool reset_by_watchdog() { return reset_by_watchdog_; }
bool active_low() { return low_gives_current; }
std::uint32_t nonce() { return retained.starts << 16 | 1u; }

void start_line(std::uint32_t baud) {
  reg(uart_divider) = clock / baud;
  reg(uart_control) = both_ways_with_interrupts;
  cortex_m::enable(line_came, cortex_m::of_line);
  cortex_m::enable(line_sent, cortex_m::of_line);
}

// The computer that runs the emulator may be busy with other programs.
std::uint32_t longest_pause() { return 10'000; }

void start_watchdog() {
  reg(watchdog_lock) = unlocked;
  reg(watchdog_load) = clock / 100;  // 10 ms to the interrupt, and 10 ms to the reset
  reg(watchdog_control) = interrupt_and_reset;
}

void feed_watchdog() {
  if (stops_feeding && !reset_by_watchdog_ && ++feedings > 10'000) return;
  reg(watchdog_clear) = 1;
}

void start_ticks() {
  last_look = reg(running + value);
  count.start(clocks_a_tick, clocks());
  reg(ticking + reload) = clocks_a_tick - 1;
  reg(ticking + control) = enabled | interrupts;
  cortex_m::enable(time_is_over, cortex_m::of_tick);
}

std::uint32_t ticks_passed() { return count.passed(clocks()); }

void start_conversion(signals::Channel channel) { converted = channel; }

// Returns the host's reading. The host has the instant of the sample; it is requested when the
// result is due.
signals::Reading reading(Tick run) {
  if (host == nullptr) return {2'048, Status::ok};
  for (;;) {
    const Host::Converted from = host->convert(static_cast<std::uint64_t>(run), converted.index);
    if (from.status < board::failure::stalls)
      return {from.number, static_cast<Status>(from.status)};
    if (from.status == board::failure::resets) cortex_m::reset_all();
    stand_still(from.number);
  }
}

void drive(const Drive& d) {
  if (host == nullptr) return;
  host->put_valves(static_cast<std::uint64_t>(d.tick), d.open, d.current, d.supply);
  host->send();
}

void block_ticks() { cortex_m::block_ticks(); }
void allow_ticks() { cortex_m::allow_ticks(); }

// The interrupt checks whether there is something to send and room for it.
void wake_sender() { cortex_m::request(line_sent); }

// Does not sleep: the emulator's clock would jump to the time at which the host computer wakes it,
// and ticks would be missed (up to 25 were).
void idle() { look_at_stack(); }

}  // namespace hardware
}  // namespace sinew::firmware

// --- start-up and interrupts --------------------------------------------------------------------

extern "C" {

[[noreturn]] void reset() { sinew::firmware::start_application(); }
void fault() { sinew::firmware::fail("fault\n"); }

// Handles the watchdog's first time-out; the second one resets the board.
void watchdog_interrupt() {
  sinew::firmware::retained.why = sinew::firmware::watchdog_expired;
  for (;;) {}
}

// Clears the request before it reads the bytes, since another may arrive in between.
void byte_came() {
  using namespace sinew::firmware;
  reg(uart_interrupt) = has_come;
  while (reg(uart_state) & full_of_received) received(static_cast<std::uint8_t>(reg(uart_data)));
}

void byte_sent() {
  using namespace sinew::firmware;
  reg(uart_interrupt) = sent;
  std::uint8_t byte = 0;
  for (; bytes_left > 0 && !(reg(uart_state) & full_to_send) && next_to_send(byte); --bytes_left)
    reg(uart_data) = byte;
}

void time_over() {
  using namespace sinew::firmware;
  reg(ticking + interrupt) = 1;
  tick();
  bytes_left = bytes_a_tick;
  cortex_m::request(line_sent);
}

}  // extern "C"

namespace sinew::firmware {
[[gnu::section(".vectors"), gnu::used]] constinit const auto table = [] {
  auto out = vectors<9>(
      reset, fault, {{line_came, byte_came}, {line_sent, byte_sent}, {time_is_over, time_over}});
  out.exception[1] = watchdog_interrupt;
  return out;
}();
}  // namespace sinew::firmware
