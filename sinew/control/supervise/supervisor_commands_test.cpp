// Tests the supervisor with wrong commands and late ticks.
#include "sinew/control/supervise/supervisor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "sinew/control/supervise/test_stand.h"

namespace sinew::control::supervisor_commands_test {
namespace {

// --- commands -----------------------------------------------------------------------------------

TEST(Supervisor, ImpossibleCommandsAreRejected) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  const std::function<void(JointCommand&)> wrong[] = {
      [](JointCommand& c) { c.stiffness = nan; },
      [](JointCommand& c) { c.stiffness = -2e6f; },
      [](JointCommand& c) { c.gains.angle = nan; },
      [](JointCommand& c) { c.gains.stiffness = 2e6f; },
      [](JointCommand& c) { c.gains.velocity = -std::numeric_limits<float>::infinity(); },
      [](JointCommand& c) { c.angle = std::numeric_limits<std::int32_t>::min(); },
      [](JointCommand& c) { c.angle = 40'000; },
      [](JointCommand& c) { c.duties.flexor_inlet = 101; },
      [](JointCommand& c) { c.duties.extensor_exhaust = -1; },
      [](JointCommand& c) {  // this joint has a law
        c.timed = true;
        c.openings = {};
      },
  };
  for (const auto& spoil : wrong) {
    Stand stand;
    stand.run(10);
    const Command good = stand.command;
    spoil(stand.command.joint[knee]);
    stand.run(2);
    EXPECT_EQ(stand.supervised().rejected_commands, 2u);
    EXPECT_FALSE(stand.supervised().holding);
    stand.command = good;
    stand.run(2);
    EXPECT_EQ(stand.supervised().rejected_commands, 2u);
    EXPECT_EQ(stand.trip().cause, Trip::Cause::none);
  }
}

TEST(Supervisor, OpeningsOfATimedJointEndWithItsPeriod) {
  JointControllerConfig leg = test_leg();
  leg.joint[hip].kind = JointKind::timed;
  leg.joint[hip].extensor.present = false;
  for (const Openings& openings : {Openings{{101, 0}, {}}, Openings{{0, 101}, {}},
                                   Openings{{}, {101, 0}}, Openings{{}, {0, 101}}}) {
    Stand stand(limits(), leg);
    JointCommand& command = stand.command.joint[hip];
    command.timed = true;
    command.openings = {{0, 50}, {100, 100}};
    stand.run(2);
    EXPECT_EQ(stand.supervised().rejected_commands, 0u);
    command.openings = openings;
    stand.run(2);
    EXPECT_EQ(stand.supervised().rejected_commands, 2u);
  }
}

TEST(Supervisor, ACommandFasterThanItsLimitIsRejected) {
  SuperviseConfig config = limits();
  config.command[hip].max_step = 20;
  Stand stand(config);
  stand.command.joint[hip].angle += 500;  // the first angle is not limited
  stand.run(3);
  EXPECT_EQ(stand.supervised().rejected_commands, 0u);
  stand.command.joint[hip].angle += 20;
  stand.run(1);
  EXPECT_EQ(stand.supervised().rejected_commands, 0u);
  stand.command.joint[hip].angle += 21;
  stand.run(1);
  EXPECT_EQ(stand.supervised().rejected_commands, 1u);
}

TEST(Supervisor, ThreeBadCommandsHoldAndSixVent) {
  Stand stand;
  stand.fill();
  stand.run(10);
  EXPECT_TRUE(stand.valves.is_open(4 * hip));
  stand.command.joint[hip].stiffness = std::numeric_limits<float>::quiet_NaN();
  stand.run(2);
  EXPECT_TRUE(stand.valves.is_open(4 * hip));
  stand.now = stand.visit(stand.now);  // the third
  EXPECT_TRUE(stand.supervised().holding);
  EXPECT_FALSE(stand.valves.an_inlet_open());
  EXPECT_FALSE(stand.valves.an_exhaust_open());
  EXPECT_EQ(stand.trip().cause, Trip::Cause::none);
  while (stand.now < 1500) {
    stand.now = stand.visit(stand.now);
    EXPECT_FALSE(stand.valves.an_inlet_open());
    EXPECT_FALSE(stand.valves.an_exhaust_open());
  }
  EXPECT_EQ(stand.supervised().rejected_commands, 5u);
  stand.visit(stand.now);
  EXPECT_EQ(stand.trip().cause, Trip::Cause::command);
  EXPECT_EQ(stand.trip().joint, hip);
  EXPECT_EQ(stand.trip().at, 1500);
  EXPECT_TRUE(stand.valves.all_exhausts_open());
}

TEST(Supervisor, AGoodCommandEndsTheHold) {
  Stand stand;
  stand.fill();
  const Command good = stand.command;
  stand.run(10);
  stand.command.joint[hip].stiffness = 1e30f;
  stand.run(5);
  EXPECT_TRUE(stand.supervised().holding);
  stand.command = good;
  stand.run(3);
  EXPECT_FALSE(stand.supervised().holding);
  EXPECT_TRUE(stand.valves.is_open(4 * hip));
  EXPECT_EQ(stand.supervised().holds, 1u);
}

// --- the clock ----------------------------------------------------------------------------------

TEST(Supervisor, JumpingToTheNextEventIsNoGap) {
  Stand stand;
  stand.run(100);
  EXPECT_EQ(stand.supervised().gaps, 0u);
}

TEST(Supervisor, AGapOfTwoTicksShutsInlets) {
  Stand stand;
  stand.run(10);  // inlets open at count 100 of a period, for 30 ticks
  while (stand.now < 1013) stand.now = stand.visit(stand.now);
  ASSERT_TRUE(stand.valves.is_open(4 * hip));
  const Tick next = stand.now;
  stand.visit(next + 2);
  EXPECT_FALSE(stand.valves.an_inlet_open());
  EXPECT_EQ(stand.supervised().gaps, 1u);
  EXPECT_EQ(stand.supervised().worst_gap, 2u);
  EXPECT_EQ(stand.trip().cause, Trip::Cause::none);
}

TEST(Supervisor, AGapOfTenMillisecondsVents) {
  for (const Tick gap : {99, 100, 5000}) {
    Stand stand;
    stand.run(10);
    const Tick first = stand.now + gap;
    stand.visit(first);
    EXPECT_FALSE(stand.valves.an_inlet_open());
    EXPECT_EQ(stand.trip().cause, gap < 100 ? Trip::Cause::none : Trip::Cause::gap);
    if (gap >= 100) {
      EXPECT_EQ(stand.vented, first);
    }
  }
}

// A law in the gap would have shut the valve.
TEST(Supervisor, AJointWhoseLawWasSkippedIsShut) {
  Stand stand;
  stand.fill();
  while (stand.now < 1009) stand.now = stand.visit(stand.now);
  EXPECT_TRUE(stand.valves.is_open(4 * hip));
  stand.now = stand.visit(1010);
  EXPECT_EQ(stand.supervised().worst_gap, 1u);
  EXPECT_FALSE(stand.valves.is_open(4 * hip));
  EXPECT_FALSE(stand.valves.is_open(4 * hip + 3));
  EXPECT_TRUE(stand.valves.is_open(4 * knee));  // its law comes later
  stand.run(2);
  EXPECT_TRUE(stand.valves.is_open(4 * hip));  // the hip's law comes again
}

}  // namespace
}  // namespace sinew::control::supervisor_commands_test
