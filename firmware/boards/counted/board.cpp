// firmware/boards/counted/board.cpp - a board for counting instructions: the application's ticks
// are called one by one and their instructions counted, while a host in the same image configures,
// arms and runs the leg with commands of all kinds (firmware/worst-tick.sh).
//
// The emulator advances 1024 ns with each instruction (-icount shift=10), and a timer of 25 MHz
// counts 25.6 in this time, so that a count determines the number of instructions.
#include "firmware/board.h"

#include <array>
#include <new>

#include "firmware/cortex_m.h"
#include "firmware/level.h"
#include "firmware/same_bits.h"
#include "firmware/semihosting.h"
#include "sinew/control/joint/test_leg.h"
#include "sinew/control/link/command_queue.h"
#include "sinew/control/link/configuration.h"

namespace sinew::firmware {
namespace {

using cortex_m::reg;
using signals::Tick;

constexpr std::uint32_t ticks_of_a_run = 60'000;

constexpr std::uintptr_t timer = 0x40001000, timer_value = timer + 4, timer_reload = timer + 8;

std::uint32_t counts() { return reg(timer_value); }  // decreasing
std::uint32_t instructions(std::uint32_t from, std::uint32_t to) {
  return ((from - to) * 10 + 128) / 256;
}

struct Figures {
  std::uint32_t ticks = 0, worst = 0, sum = 0;
  void add(std::uint32_t n) {
    ++ticks;
    sum += n;
    if (n > worst) worst = n;
  }
};
Figures of_ticks, to_valves, kept_away;
std::array<std::uint32_t, 100> worst_at;  // index: tick of the period
std::uint32_t nothing = 0, tick_begun = 0, away_since = 0;
bool in_tick = false;

// --- the host -----------------------------------------------------------------------------------

constinit Random dice(1);
std::uint8_t sequence = 0;
std::uint32_t now = 0;  // [ticks] since the reset
link::CommandFor command{.from = 0, .periods = 3, .joints = 3};

constexpr control::JointControllerConfig machine() {
  control::JointControllerConfig out = control::test_leg();
  out.timing = signals::compensated_timing(5, 12);
  return out;
}
constexpr link::Configuration leg{machine(), {}, {}};

const link::ConfigurationSender& sender() {
  alignas(
      link::ConfigurationSender) static std::array<std::uint8_t, sizeof(link::ConfigurationSender)>
      room;
  static const link::ConfigurationSender* made = nullptr;
  if (made == nullptr) made = new (room.data()) link::ConfigurationSender(leg);
  return *made;
}

template <class M>
void send(const M& message) {
  static std::array<std::uint8_t, link::max_frame> frame;
  const std::size_t size = link::encode(message, {1, sequence++}, frame);
  for (std::size_t i = 0; i < size; ++i) received(frame[i]);
}

void send_command() {
  for (std::size_t j = 0; j < 3; ++j) {
    control::JointCommand& c = command.joint[j];
    c.angle = static_cast<std::int32_t>(1'000 + dice.below(2'000));
    c.stiffness = 60.0f * dice.unit();
    c.gains = {0.3f * dice.unit(), 8.0f * dice.unit(), 0.002f * dice.unit()};
    c.enabled = dice.below(8) != 0;
    c.open_loop = dice.below(16) == 0;
    c.duties = {static_cast<std::int32_t>(dice.below(100)), 0, 0,
                static_cast<std::int32_t>(dice.below(100))};
  }
  send(command);
  command.from += 100;
}

// Sends one message per tick at most, so that the line's buffer does not overflow.
void host() {
  if (now == 0) send(sender().begin());
  if (now > 0 && now <= sender().chunks) send(sender().chunk(now - 1));
  if (now == 100) send(sender().end());
  if (now == 500) send(link::ClearFault{});
  if (now == 2'000) send(link::ArmFirst{sender().crc()});
  if (now == 2'010) send(link::ArmSecond{hardware::nonce() + 1, sender().crc()});
  if (now == 2'013) send(link::EdgesWanted{true});
  if (now == 2'020 || (now > 2'020 && (now - 2'020) % 100 == 50)) send_command();
}

// --- output -------------------------------------------------------------------------------------

[[noreturn]] void end() {
  print_number("worst_tick ", of_ticks.worst);
  print_number("\nmean_tick ", of_ticks.sum / of_ticks.ticks);
  print_number("\nto_valves ", to_valves.worst);
  print_number("\nkept_away ", kept_away.worst);
  print_number("\nswitchings ", to_valves.ticks);
  print_number("\nstack ", cortex_m::deepest_stack());
  for (std::uint32_t i = 0; i < worst_at.size(); ++i)
    if (worst_at[i] > of_ticks.worst / 2) {
      print_number("\n# tick ", i);
      print_number(" of a period: ", worst_at[i]);
    }
  print("\n");
  quit(0);
}

}  // namespace

// --- board.h ------------------------------------------------------------------------------------

namespace hardware {

void start() {
  reg(timer_reload) = 0xFFFFFFFF;
  reg(timer) = 1;
  const std::uint32_t from = counts();
  nothing = instructions(from, counts());
}

const char* name() { return "counted"; }
bool reset_by_watchdog() { return false; }
bool active_low() { return low_gives_current; }
std::uint32_t nonce() { return 1; }
void start_line(std::uint32_t) {}
std::uint32_t longest_pause() { return 50; }
void start_watchdog() {}
void feed_watchdog() {}
void start_ticks() {}
std::uint32_t ticks_passed() { return 1; }
void start_conversion(signals::Channel) {}
signals::Reading reading(Tick) {
  return {static_cast<std::uint16_t>(1'500 + dice.below(64)), signals::Status::ok};
}
void drive(const Drive&) {
  if (in_tick && now >= 2'020) to_valves.add(instructions(tick_begun, counts()) - nothing);
}
void block_ticks() { away_since = counts(); }
void allow_ticks() {
  if (now > 2'020) kept_away.add(instructions(away_since, counts()) - nothing);
}
void wake_sender() {
  for (std::uint8_t byte = 0; next_to_send(byte);) {}
}

// Runs the next tick, since run() has nothing left to do.
void idle() {
  host();
  in_tick = true;
  tick_begun = counts();
  tick();
  const std::uint32_t n = instructions(tick_begun, counts()) - nothing;
  in_tick = false;
  if (now >= 2'020) {
    of_ticks.add(n);
    std::uint32_t& worst = worst_at[(now - 2'021) % 100];
    if (n > worst) worst = n;
  }
  if (++now == ticks_of_a_run) end();
}

}  // namespace hardware
}  // namespace sinew::firmware
