// firmware/application.cpp - program of every board: it joins the board's functions (board.h) and
// the program of sinew/control/board.
//
// A tick begins with what needs exact timing: outputs that were decided before are written to the
// valves, a reading is taken and the next conversion started. Computation follows.
#include <array>
#include <new>

#include "firmware/board.h"
#include "firmware/line_ring.h"
#include "sinew/control/board/program.h"
#include "sinew/control/link/baud.h"

namespace sinew::firmware {
namespace {

using signals::Conversion;
using signals::Reading;
using signals::Status;
using signals::Tick;

// Number of ticks without a round of run() after which the watchdog is no longer fed. The longest
// round takes a configuration; in the emulator, whose clock counts instructions, 2 would be enough
// for it.
constexpr std::uint32_t patience = 200;

// Storage of the program, which run() constructs: the language's start-up code does not run on a
// board.
alignas(board::Program) constinit std::array<std::uint8_t, sizeof(board::Program)> room{};
board::Program& program() { return *reinterpret_cast<board::Program*>(room.data()); }

constinit LineRing<512> from_line;
constinit LineRing<1'024> to_line;

// Shared by tick() and run(). The count of ticks wraps round.
constinit std::atomic<std::uint32_t> ticks = 0, last_round = 0;

// State of the line in run().
std::uint32_t last_byte = 0;  // [ticks]
bool in_frame = false;        // bytes came, and the pause after them is not over

// Conversion in progress, and its start.
struct Sampling {
  std::uint8_t channel = 0xff;
  Tick since = -1;
};
constinit Sampling sampling;
constinit hardware::Drive driven;

Reading read(const Conversion& c, Tick now) {
  const Reading reading = hardware::reading(program().safety().run_tick(now));
  const bool is_it =
      sampling.channel == c.channel.index && now - sampling.since == c.read - c.start;
  return is_it ? reading : Reading{0, Status::late};
}

void sample(const Conversion& c, Tick now) {
  hardware::start_conversion(c.channel);
  sampling = {c.channel.index, now};
}

void drive(const board::Outputs& out, Tick now) {
  const bool low = hardware::active_low();
  const control::OpenMask inverted = program().safety().outputs().inverted();
  const std::uint32_t coils =
      out.current ? control::drive_word(out.open, inverted, low) : control::rest_word(low);
  if (coils == driven.coils && out.open == driven.open && out.current == driven.current &&
      out.supply == driven.supply)
    return;
  driven = {.tick = program().safety().run_tick(now),
            .open = out.open,
            .coils = coils,
            .current = out.current,
            .supply = out.supply};
  hardware::drive(driven);
}

struct Ticks {
  void block() noexcept { hardware::block_ticks(); }
  void allow() noexcept { hardware::allow_ticks(); }
};

// Passes received bytes to the program. A byte that it has no room for waits until the program has
// processed others.
void listen() {
  std::uint8_t byte = 0;
  bool any = false;
  while (from_line.take(byte)) {
    any = in_frame = true;
    while (program().receive({&byte, 1}) == 0) program().serve(Ticks{});
  }
  const std::uint32_t now = ticks.load(std::memory_order_relaxed);
  if (any) last_byte = now;
  if (!in_frame || now - last_byte <= hardware::longest_pause()) return;
  program().silent();
  in_frame = false;
}

void send() {
  std::array<std::uint8_t, 64> bytes;
  bool any = false;
  while (to_line.room() >= bytes.size()) {
    const std::size_t n = program().transmit(bytes);
    if (n == 0) break;
    for (std::size_t i = 0; i < n; ++i) to_line.put(bytes[i]);
    any = true;
  }
  if (any) hardware::wake_sender();
}

board::Identification identification() {
  board::Identification who{.firmware = {'0', '.', '1', '.', '0'},
                            .nonce = hardware::nonce(),
                            .reset_by_watchdog = hardware::reset_by_watchdog(),
                            .active_low = hardware::active_low()};
  const char* name = hardware::name();
  for (std::size_t i = 0; i + 1 < who.board.size() && name[i] != 0; ++i)
    who.board[i] = static_cast<decltype(who.board)::value_type>(name[i]);
  return who;
}

}  // namespace

void received(std::uint8_t byte) { from_line.put(byte); }
bool next_to_send(std::uint8_t& byte) { return to_line.take(byte); }

void tick() {
  board::Program& p = program();
  const std::uint32_t passed = hardware::ticks_passed();
  if (passed == 0) return;
  if (passed > 1) p.miss(passed - 1);
  const Tick now = p.now();
  drive(p.begin_tick(), now);
  const Conversion* c = p.due();
  const Reading reading = c != nullptr ? read(*c, now) : Reading{};
  if (const Conversion* next = p.begins()) sample(*next, now);
  if (c != nullptr) p.take(*c, reading);
  const bool good = p.end_tick();
  const std::uint32_t count = ticks.load(std::memory_order_relaxed) + passed;
  ticks.store(count, std::memory_order_relaxed);
  if (good && count - last_round.load(std::memory_order_relaxed) < patience)
    hardware::feed_watchdog();
}

void run() {
  hardware::start();
  new (room.data()) board::Program(identification());
  driven.coils = control::rest_word(hardware::active_low());
  hardware::drive(driven);
  hardware::start_line(link::firmware_baud);
  hardware::start_watchdog();
  hardware::start_ticks();
  for (;;) {
    last_round.store(ticks.load(std::memory_order_relaxed), std::memory_order_relaxed);
    listen();
    const bool more = program().serve(Ticks{});
    send();
    if (!more) hardware::idle();
  }
}

}  // namespace sinew::firmware
