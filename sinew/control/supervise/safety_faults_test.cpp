// Tests faults of sensors, clock, memory and air: rows of docs/reference/supervision.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <random>

#include "sinew/control/supervise/safety.h"
#include "sinew/control/supervise/test_bench.h"

namespace sinew::control::safety_faults_test {
namespace {

using signals::Reading;

// --- sensors and clock --------------------------------------------------------------------------

// Open, short or saturated: out of range; faster than possible; conversion not finished.
TEST(Safety, ASensorThatFailsVentsInThreeScans) {
  JointControllerConfig leg = test_leg();
  leg.hold_limit = 3;
  for (const Reading wrong : {Reading{0, Status::ok}, Reading{4095, Status::ok},
                              Reading{2600, Status::ok}, Reading{0, Status::late}}) {
    SupervisedBench b({}, limits(), leg);
    b.start();
    b.run(1'000);
    const Tick from = b.now;
    b.replace_reading = [&](std::uint8_t channel, Tick, Reading r) {
      return channel == hip_angle ? wrong : r;
    };
    ASSERT_TRUE(b.reaches(BoardState::vent, 1'000));
    EXPECT_LE(b.entered - from, 301 + 5);
    b.run(5);
    EXPECT_EQ(b.open & leg_inlets, 0u);
    EXPECT_EQ(b.open & leg_exhausts, leg_exhausts);
    EXPECT_EQ(b.board.fault(),
              wrong.status == Status::ok ? BoardFault::supervisor : BoardFault::controller);
    ASSERT_TRUE(b.reaches(BoardState::fault, 20'000));
  }
}

// Missed ticks: one is counted; after two, inlets are shut at the first tick, as are valves that
// should have shut meanwhile; 10 ms end the run.
TEST(Safety, OneMissedTickIsCountedTwoShutTheInletsAndTenMillisecondsVent) {
  constexpr OpenMask inlets = 0x055;  // of hip and knee
  for (const Tick missed : {1, 2, 30, 99, 100, 5'000}) {
    SupervisedBench b;
    for (JointCommand& c : b.command.joint) c.duties = {100, 0, 0, 100};
    b.start();
    b.run(1'000 + 20);
    ASSERT_NE(b.open & inlets, 0u);
    b.now += missed;
    b.tick();
    const Supervised& statistics = b.board.controller()->supervised();
    EXPECT_EQ(statistics.gaps, 1u);
    EXPECT_EQ(statistics.worst_gap, missed);
    if (missed == 1) {
      EXPECT_NE(b.open & inlets, 0u);
    } else {
      EXPECT_EQ(b.open & inlets, 0u);
    }
    EXPECT_EQ(b.board.state(), missed < 100 ? BoardState::running : BoardState::vent);
    if (missed >= 100) {
      EXPECT_EQ(b.open & leg_exhausts, leg_exhausts);
    }
  }
}

// --- memory and watchdog ------------------------------------------------------------------------

TEST(Safety, OneChangedBitOfTheParametersDumpsWithinTwoLooks) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 24; ++trial) {
    SupervisedBench b;
    b.start();
    b.run(2'500);
    const Supervisor& run = *b.board.controller();
    const bool of_limits = trial % 2;
    auto* bytes = const_cast<unsigned char*>(
        of_limits ? reinterpret_cast<const unsigned char*>(&run.limits())
                  : reinterpret_cast<const unsigned char*>(&run.config()));
    // Memory that no law uses in this run: the last joints, the last channels.
    const std::size_t size = of_limits ? sizeof(SuperviseConfig) : sizeof(JointControllerConfig);
    const std::size_t joint = offsetof(JointControllerConfig, joint) + 5 * sizeof(JointConfig);
    const std::size_t at = of_limits
                               ? 20 * sizeof(SensorLimits) + random() % (10 * sizeof(SensorLimits))
                               : joint + random() % (2 * sizeof(JointConfig));
    ASSERT_LT(at, size);
    bytes[at] = static_cast<unsigned char>(bytes[at] ^ 1u << random() % 8);
    const Tick from = b.now;
    ASSERT_TRUE(b.reaches(BoardState::dump, 3'000)) << trial;
    EXPECT_LE(b.entered - from, 2'000);
    EXPECT_EQ(b.board.fault(), BoardFault::parameters);
    EXPECT_EQ(b.open, 0u);
    EXPECT_FALSE(b.board.supply());
    b.run(500);
    b.board.clear(false, b.now);
    b.board.clear(true, b.now);
    b.run(2'000);
    EXPECT_FALSE(b.board.arm_first(b.now)) << "until it is configured again";
  }
}

TEST(Safety, OnlyATickThatWasWorkedOffFeedsTheWatchdog) {
  SupervisedBench b;
  b.start();
  b.run(100);
  EXPECT_TRUE(b.fed);
  b.board.begin(b.now);
  EXPECT_FALSE(b.board.end(b.now)) << "nothing else was done";
  (void)b.board.edges(b.now);
  EXPECT_FALSE(b.board.end(b.now)) << "valves were not set";
  (void)b.board.open(b.now);
  EXPECT_TRUE(b.board.end(b.now)) << "no reading is due at a tick like this";
  ++b.now;
  while (b.board.run_tick(b.now) % 100 != 3) b.tick();
  b.board.begin(b.now);
  (void)b.board.edges(b.now);
  ASSERT_NE(b.board.due(b.now), nullptr);
  (void)b.board.open(b.now);
  EXPECT_FALSE(b.board.end(b.now)) << "a reading was due and not taken";
}

TEST(Safety, AfterTheWatchdogHasBittenItIsADump) {
  Safety board(true);
  EXPECT_EQ(board.state(), BoardState::dump);
  EXPECT_EQ(board.fault(), BoardFault::watchdog);
  EXPECT_FALSE(board.supply());
  EXPECT_EQ(board.word(0, false), 0u);
  EXPECT_EQ(board.word(0, true), ~0u);
}

// --- venting ------------------------------------------------------------------------------------

TEST(Safety, AVentLastsUntilTheMusclesAreEmptyAndAsLongAsTheControllersOwn) {
  constexpr Tick own = JointControllerConfig{}.shutdown_vent;
  SafetyConfig config;
  for (const std::uint8_t channel : {3, 4, 5, 6}) config.empty_at[channel] = 300;
  for (const Tick empty_after : {500, 8'000, 30'000}) {
    SupervisedBench b(config);
    b.start();
    b.run(500);
    b.board.shut_down(b.now);
    const Tick from = b.now;
    b.replace_reading = [&](std::uint8_t channel, Tick now, Reading r) {
      if (channel >= 3 && now - from >= empty_after) r.counts = 200;
      return r;
    };
    const Tick shortest = std::max(empty_after, own);
    while (b.now < from + shortest) {
      b.tick();
      ASSERT_EQ(b.open & leg_exhausts, leg_exhausts);
    }
    ASSERT_TRUE(b.reaches(BoardState::idle, 500));
    EXPECT_LE(b.entered - from, shortest + 301);
    EXPECT_EQ(b.open, 0u);
  }
}

TEST(Safety, WhatIsNotEmptyAfterTheLongestVentIsDumped) {
  SafetyConfig config;
  config.empty_at[3] = 300;
  config.vent_limit = 20'000;
  SupervisedBench b(config);
  b.start();
  b.run(500);
  b.board.shut_down(b.now);
  const Tick from = b.now;
  ASSERT_TRUE(b.reaches(BoardState::dump, 30'000));
  EXPECT_LE(b.entered - from, 20'001);
  EXPECT_EQ(b.board.fault(), BoardFault::not_empty);
}

}  // namespace
}  // namespace sinew::control::safety_faults_test
