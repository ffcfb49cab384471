// A port on this computer, with registers that are entries of a map: its writes, their order, and
// the effect of its edges. It cannot show that a chip has these registers.
#include <gtest/gtest.h>

#include "firmware/edges.h"
#include "sinew/run/bring_up/pins.h"
#include "tests/firmware/boards/wiring.h"

std::uint32_t stack_top[1];

namespace sinew::firmware {

namespace cortex_m {
Registers& registers() {
  static Registers all;
  return all;
}
}  // namespace cortex_m

// --- the application, as its interrupts see it ---------------------------------------------------

namespace {
int ticks = 0;
}
void run() { throw 0; }
void tick() { ++ticks; }
void received(std::uint8_t) {}
bool next_to_send(std::uint8_t&) { return false; }

namespace {

using hardware::Drive;

std::uint32_t& value(std::uintptr_t address) { return cortex_m::registers().value[address]; }

class Board : public testing::Test {
 protected:
  void SetUp() override {
    cortex_m::registers() = {};
    wiring.power_on();
    cortex_m::registers().on_write = wiring.act;
    value(wiring.count) = tick_;
  }
  void started() {
    hardware::start();
    value(wiring.count) = tick_;
    hardware::start_ticks();
    next_tick();
  }
  // The next tick has begun, and its interrupt has come.
  void next_tick() {
    value(wiring.count) = tick_ += 100 * wiring.clocks_a_us;
    EXPECT_EQ(hardware::ticks_passed(), 1u);
  }
  void later(std::uint32_t microseconds) {
    value(wiring.count) = tick_ + microseconds * wiring.clocks_a_us;
  }

  // All outputs, and the supply's above them.
  static std::uint32_t current() {
    std::uint32_t out = 0;
    for (std::uint32_t i = 0; i <= wiring.outputs; ++i)
      out |= std::uint32_t{wiring.has_current(i)} << i;
    return out;
  }
  static std::uint32_t supply() { return 1u << wiring.outputs; }

  std::uint32_t tick_ = 1'000;  // its beginning, as the running timer counts
};

// `coils`: those that are to have current.
std::uint32_t levels(std::uint32_t coils) { return low_gives_current ? ~coils : coils; }
Drive of_run(std::uint32_t coils) {
  return {.tick = 5, .open = coils, .coils = levels(coils), .current = true, .supply = true};
}
Drive at_rest(std::uint32_t coils) { return {.tick = -1, .coils = levels(coils)}; }

TEST_F(Board, NoPinBecomesAnOutputThatHasCurrent) {
  cortex_m::registers().on_write = [](std::uintptr_t address, std::uint32_t written) {
    wiring.act(address, written);
    for (std::uint32_t i = 0; i <= wiring.outputs; ++i)
      ASSERT_FALSE(wiring.drives(i) && wiring.has_current(i)) << i << ", " << std::hex << address;
  };
  hardware::start();
  for (std::uint32_t i = 0; i <= wiring.outputs; ++i) EXPECT_TRUE(wiring.drives(i)) << i;
}

TEST_F(Board, EachOutputIsItsPinAndNoOther) {
  started();
  for (std::uint32_t i = 0; i < wiring.outputs; ++i) {
    hardware::drive(at_rest(1u << i));
    EXPECT_EQ(current(), 1u << i);
  }
  hardware::drive({.tick = -1, .coils = levels(0), .supply = true});
  EXPECT_EQ(current(), supply());
  hardware::drive({.tick = -1, .coils = levels(~0u), .current = false});
  EXPECT_EQ(current(), 0u);
}

TEST_F(Board, TheLevelThatGivesCurrentIsReportedToTheHost) {
  started();
  hardware::drive(at_rest(0));
  EXPECT_EQ(hardware::active_low(), low_gives_current);
}

TEST_F(Board, EachInputIsTheConvertersInTheTable) {
  started();
  for (std::uint32_t i = 0; i < wiring.inputs; ++i) {
    hardware::start_conversion({static_cast<std::uint8_t>(i)});
    EXPECT_EQ(wiring.converter_input(), wiring.input_of(i)) << i;
  }
}

TEST_F(Board, ARunsWordWaitsForItsInstant) {
  started();
  for (const std::uint32_t ready : {2u, 10u, 18u}) {
    hardware::drive(at_rest(0));
    later(ready);
    hardware::drive(of_run(3));
    EXPECT_EQ(current(), 0u) << ready;
    EXPECT_EQ(value(wiring.compare), tick_ + edge_delay * wiring.clocks_a_us);
    edge_due();
    EXPECT_EQ(current(), 3u | supply()) << ready;
    next_tick();
  }
}

TEST_F(Board, AWordThatIsLateGoesAtOnce) {
  started();
  for (const std::uint32_t ready : {20u, 21u, 60u}) {
    hardware::drive(at_rest(0));
    later(ready);
    hardware::drive(of_run(5));
    EXPECT_EQ(current(), 5u | supply()) << ready;
  }
}

TEST_F(Board, OffIsAtOnceAndStays) {
  started();
  const Drive dump{.tick = 5, .coils = levels(~0u), .current = false};
  Drive fault = of_run(0);
  fault.supply = false;
  for (const Drive& off : {dump, fault, at_rest(0)}) {
    hardware::drive(of_run(7));
    hardware::drive(off);
    EXPECT_EQ(current(), 0u);
    edge_due();  // of the older word
    EXPECT_EQ(current(), 0u);
    time_over();
    EXPECT_EQ(current(), 0u);
    next_tick();
  }
}

TEST_F(Board, AWordWhoseCompareNeverComesGoesWithTheNextTick) {
  started();
  hardware::drive(of_run(9));
  EXPECT_EQ(current(), 0u);
  const int before = ticks;
  time_over();
  EXPECT_EQ(current(), 9u | supply());
  EXPECT_EQ(ticks, before + 1);
}

TEST_F(Board, EdgesAreAboveTheLineAndThatAboveTheTicks) {
  started();
  hardware::start_line(921'600);
  const auto& priority = cortex_m::registers().priority;
  EXPECT_LT(priority.at(wiring.edges), priority.at(wiring.line));
  EXPECT_LT(priority.at(wiring.line), priority.at(wiring.ticks));
}

TEST_F(Board, TicksThatWereMissedAreCounted) {
  started();
  value(wiring.count) += 300 * wiring.clocks_a_us + 20;
  EXPECT_EQ(hardware::ticks_passed(), 3u);
  value(wiring.count) += 100 * wiring.clocks_a_us - 10;
  EXPECT_EQ(hardware::ticks_passed(), 1u);
}

TEST_F(Board, ItsOutputsAreAtThePinsThatTheDrawingNames) {
  const run::Pins* pins = run::pins_of(wiring.board);
  ASSERT_NE(pins, nullptr);
  EXPECT_EQ(pins->inputs.size(), wiring.inputs);
  ASSERT_EQ(pins->outputs.size(), wiring.outputs);
  for (std::uint32_t i = 0; i < wiring.outputs; ++i) EXPECT_EQ(pins->outputs[i], wiring.pin(i));
  EXPECT_EQ(pins->supply, wiring.pin(wiring.outputs));
}

}  // namespace
}  // namespace sinew::firmware
