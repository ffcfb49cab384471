// The application in the emulator, on a clock that counts instructions: a host configures, arms and
// runs it over its serial line, as it would a board on the bench.
#include <gtest/gtest.h>

#include <algorithm>

#include "sinew/control/joint/test_leg.h"
#include "tests/firmware/images.h"
#include "tests/firmware/machine.h"

namespace sinew::firmware {
namespace {

using control::BoardFault;
using control::BoardState;
using link::Code;

// 2,048 are the goal; 1,320 of them are part_of()'s copy of a state message.
constexpr int deepest_stack = 2'048;  // [bytes]

bool send_configuration(Host& host, const link::ConfigurationSender& sender) {
  if (host.ask(sender.begin()) != Code::done) return false;
  for (std::size_t i = 0; i < sender.chunks; ++i)
    if (host.ask(sender.chunk(i)) != Code::done) return false;
  return host.ask(sender.end()) == Code::done;
}

std::uint32_t configure(Host& host) {
  const link::ConfigurationSender sender({control::test_leg(), {}, {}});
  EXPECT_TRUE(send_configuration(host, sender));
  return sender.crc();
}

// Its scan must be complete before a fault is cleared, and its constants read once before it is
// armed.
void arm(Host& host, std::uint32_t configuration) {
  const auto armed = [&] {
    return host.ask(link::ArmFirst{configuration}) == Code::done &&
           host.ask(link::ArmSecond{host.answer->value, configuration}) == Code::done;
  };
  EXPECT_TRUE(host.wait([&] { return host.ask(link::ClearFault{}) == Code::done; }));
  EXPECT_TRUE(host.wait(armed));
}

// A command for each period from its telemetry on, good for the next ones too.
void run(Host& host, int periods) {
  const control::Command command = control::rest_command(control::test_leg());
  link::CommandFor message{.from = 0, .periods = 20, .joints = 3, .joint = command.joint};
  host.send(message);
  const int end = host.telemetries + periods;
  for (int known = host.telemetries; host.telemetries < end; known = host.telemetries) {
    if (!host.wait([&] { return host.telemetries > known; })) break;
    // A board whose host was silent for 100 ms holds until the next command.
    if (host.telemetry.state != BoardState::running && host.telemetry.state != BoardState::hold)
      continue;
    message.from = host.telemetry.tick + 200;
    host.send(message);
  }
}

TEST(Application, IsConfiguredArmedRunAndShutDownOverItsSerialLine) {
  if (missing()) GTEST_SKIP() << what_is_missing;
  Machine machine("mps2-an386", image("application-mps2_an386"));
  Host host(machine.line());
  host.send(link::Identify{});
  ASSERT_TRUE(host.wait([&] { return host.identity.has_value(); }));
  EXPECT_STREQ(reinterpret_cast<const char*>(host.identity->board.data()), "mps2-an386");
  EXPECT_EQ(host.identity->state, BoardState::fault);

  arm(host, configure(host));
  // A run in which a busy computer delayed this host gives no result on lost bytes.
  std::uint32_t lost = 0, lost_to_board = 0;
  for (int tries = 0; tries < 10; ++tries) {
    host.longest_pause();
    const int before = host.telemetries;
    const std::uint32_t lost_before = host.joined().lost();
    const std::uint32_t to_board_before = host.telemetry.link.lost;
    run(host, 100);
    EXPECT_GE(host.telemetries - before, 100);
    lost = host.joined().lost() - lost_before;
    lost_to_board = host.telemetry.link.lost - to_board_before;
    if (host.longest_pause() < milliseconds(6)) break;
  }
  EXPECT_EQ(host.telemetry.state, BoardState::running);
  EXPECT_EQ(lost, 0u);
  EXPECT_EQ(lost_to_board, 0u) << "frames to the board";
  EXPECT_EQ(host.telemetry.controller.reading[1].counts, 2'048);
  EXPECT_EQ(host.telemetry.controller.late, 0u);
  EXPECT_EQ(host.telemetry.supervised.gaps, 0u) << "missed ticks";

  EXPECT_TRUE(host.wait([&] { return host.ask(link::ShutDown{}) == Code::done; }));
  const auto vented = [&] {
    return std::any_of(host.events.begin(), host.events.end(),
                       [](const link::Event& e) { return e.state == BoardState::vent; });
  };
  EXPECT_TRUE(host.wait(vented));
  EXPECT_TRUE(host.wait([&] { return host.telemetry.state == BoardState::idle; }));
  for (const link::Event& e : host.events) EXPECT_NE(e.fault, BoardFault::watchdog);

  const std::string words = "deepest stack ", printed = machine.printed();
  const std::size_t at = printed.rfind(words);
  ASSERT_NE(at, std::string::npos);
  EXPECT_LE(std::stoi(printed.substr(at + words.size())), deepest_stack);
}

// The emulator runs its timers twelve times too fast and has neither its clocks nor its pins: no
// more than this can be tested of that board.
TEST(Application, OfTheStm32f405StartsIdentifiesItselfAndIsConfigured) {
  if (missing()) GTEST_SKIP() << what_is_missing;
  Machine machine("netduinoplus2", image("application-stm32f405"), "", 0);
  Host host(machine.line());
  for (int i = 0; i < 20 && !host.identity; ++i) {  // bytes that arrive before it listens are lost
    host.send(link::Identify{});
    host.wait([&] { return host.identity.has_value(); }, milliseconds(500));
  }
  ASSERT_TRUE(host.identity.has_value());
  EXPECT_STREQ(reinterpret_cast<const char*>(host.identity->board.data()), "stm32f405");
  configure(host);
  const int before = host.telemetries;
  EXPECT_TRUE(host.wait([&] { return host.telemetries > before + 20; }));
}

TEST(Application, TheWatchdogTripsWithoutAResetAndTheBoardReportsIt) {
  if (missing()) GTEST_SKIP() << what_is_missing;
  Machine machine("mps2-an386", image("application-mps2_an386"), "starve");
  Host host(machine.line());
  const auto reset_by_watchdog = [&] {
    return !host.events.empty() && host.events.back().fault == BoardFault::watchdog;
  };
  EXPECT_TRUE(host.wait(reset_by_watchdog, milliseconds(15'000)));
  EXPECT_EQ(host.events.back().what, link::Event::What::started);
  EXPECT_EQ(host.events.back().state, BoardState::dump);
}

}  // namespace
}  // namespace sinew::firmware
