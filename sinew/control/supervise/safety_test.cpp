// Tests a board's states from power-up through a run, and conditions that always hold;
// safety_faults_test.cpp has faults of sensors, clock and memory.
#include "sinew/control/supervise/safety.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

#include "sinew/control/supervise/test_bench.h"

namespace sinew::control::safety_test {
namespace {

using signals::Edge;
using signals::Reading;

// --- from power-up to a run ---------------------------------------------------------------------

TEST(Safety, PowerUpIsAFaultThatOnlyARisingEdgeLeaves) {
  SupervisedBench b;
  b.commands = true;
  EXPECT_EQ(b.board.state(), BoardState::fault);
  EXPECT_EQ(b.board.fault(), BoardFault::power_up);
  EXPECT_FALSE(b.board.supply());
  b.run(2'000);
  EXPECT_FALSE(b.board.arm_first(b.now));
  EXPECT_FALSE(b.board.clear(true, b.now)) << "a line that is high from the start is no edge";
  EXPECT_FALSE(b.board.clear(true, b.now));
  EXPECT_EQ(b.board.state(), BoardState::fault);
  EXPECT_FALSE(b.board.clear(false, b.now));
  EXPECT_TRUE(b.board.clear(true, b.now));
  EXPECT_EQ(b.board.state(), BoardState::idle);
  EXPECT_FALSE(b.board.command(b.command, b.now)) << "not armed";
  b.run(500);
  EXPECT_EQ(b.board.state(), BoardState::idle);
  EXPECT_EQ(b.open, 0u);
}

TEST(Safety, AFaultIsNotClearedWhileASensorIsMissing) {
  for (const Reading wrong :
       {Reading{0, Status::late}, Reading{4095, Status::ok}, Reading{1895, Status::invalid}}) {
    SupervisedBench b;
    b.replace_reading = [&](std::uint8_t channel, Tick, Reading r) {
      return channel == hip_angle ? wrong : r;
    };
    b.board.clear(false, b.now);
    b.run(1'000);
    EXPECT_FALSE(b.board.clear(true, b.now));
    EXPECT_EQ(b.board.state(), BoardState::fault);
    b.replace_reading = nullptr;
    b.run(200);
    EXPECT_FALSE(b.board.clear(true, b.now)) << "the line was high all the time";
    b.board.clear(false, b.now);
    EXPECT_TRUE(b.board.clear(true, b.now));
  }
}

TEST(Safety, ArmingTakesTwoFramesInTime) {
  SupervisedBench b;
  b.board.clear(false, b.now);
  b.run(1'200);
  ASSERT_TRUE(b.board.clear(true, b.now));
  EXPECT_FALSE(b.board.arm_second(b.now)) << "without the first";
  EXPECT_FALSE(b.board.arm_first(b.now)) << "before the parameters are known";
  b.run(1'100);
  EXPECT_TRUE(b.board.arm_first(b.now));
  b.run(10'001);
  EXPECT_FALSE(b.board.arm_second(b.now)) << "too late";
  EXPECT_FALSE(b.board.arm_second(b.now)) << "the first one is used up";
  EXPECT_TRUE(b.board.arm_first(b.now));
  b.run(10'000);
  EXPECT_TRUE(b.board.arm_second(b.now));
  EXPECT_EQ(b.board.state(), BoardState::armed);
  EXPECT_TRUE(b.board.supply());
  EXPECT_NE(b.board.configure(test_leg(), limits(), {}), nullptr) << "valves may move";
}

TEST(Safety, AnArmedBoardWithoutAHostIsIdleAfterASecond) {
  SupervisedBench b;
  b.start();
  b.board.shut_down(b.now);
  b.commands = false;
  ASSERT_TRUE(b.reaches(BoardState::idle, 20'000));
  b.run(200);
  ASSERT_TRUE(b.board.arm_first(b.now));
  ASSERT_TRUE(b.board.arm_second(b.now));
  const Tick armed = b.now;
  b.run(5'000);
  b.board.note_host_alive(b.now);
  ASSERT_TRUE(b.reaches(BoardState::idle, 20'000));
  EXPECT_EQ(b.now - 1 - armed, 15'000);
  EXPECT_EQ(b.board.fault(), BoardFault::host_silent);
}

TEST(Safety, AMachineThatCannotBeIsRefusedAndNothingIsArmed) {
  const auto refused = [](const JointControllerConfig& leg) {
    Safety board;
    const char* wrong = board.configure(leg, limits(), {});
    EXPECT_FALSE(board.configured());
    return wrong == nullptr ? std::string() : std::string(wrong);
  };
  JointControllerConfig leg = test_leg();
  leg.timing = {};
  EXPECT_NE(refused(leg), "") << "no timing table";
  leg = test_leg();
  for (std::size_t duty = 60; duty <= 100; ++duty) leg.timing.closing[duty] = 0;
  EXPECT_NE(refused(leg).find("cut off or not monotone"), std::string::npos);
  leg = test_leg();
  std::swap(leg.timing.closing[40], leg.timing.closing[41]);
  EXPECT_NE(refused(leg).find("not monotone"), std::string::npos);
  leg = test_leg();
  leg.joint[hip].flexor.inlet = {32};
  EXPECT_NE(refused(leg).find("32 valves"), std::string::npos);

  Safety board;
  SafetyConfig config;
  config.host_vent = 10;
  EXPECT_NE(board.configure(test_leg(), limits(), config), nullptr);
  config = {};
  config.refractory = 101;
  EXPECT_NE(board.configure(test_leg(), limits(), config), nullptr);
}

// --- a run --------------------------------------------------------------------------------------

// The edges and counts are equal for all commands and readings.
TEST(Safety, WithoutAFaultItIsTheSupervisedController) {
  std::mt19937 random(1);
  const auto reads = [](std::uint8_t channel, Tick t) {  // any counts, equal for both
    return Reading{static_cast<std::uint16_t>((channel * 997 + t * 31) % 4096), Status::ok};
  };
  for (unsigned trial = 0; trial < 20; ++trial) {
    const JointControllerConfig leg = any_leg(random);
    const SuperviseConfig anything;

    SupervisedBench b({}, anything, leg);
    std::vector<Edge> edges;
    b.on_edge = [&](const Edge& e) { edges.push_back(e); };
    b.replace_reading = [&](std::uint8_t channel, Tick now, Reading) {
      const Tick t = b.board.run_tick(now);
      return reads(channel, t < 0 ? now : t);
    };
    std::mt19937 commands(trial);
    b.command = any_command(commands, leg, false);
    b.start();  // includes the run's first tick
    for (Tick t = 1; t < 20'000; ++t) {
      if (t % leg.period == 0) b.command = any_command(commands, leg, false);
      b.tick();
    }

    Supervisor alone(leg, anything);
    std::vector<Edge> expected;
    commands.seed(trial);
    for (Tick t = 0; t < 20'000; t = alone.next_event(t)) {
      if (alone.starts_period(t)) alone.command(any_command(commands, leg, false));
      for (const Edge& e : alone.edges(t)) expected.push_back(e);
      if (const signals::Conversion* c = alone.due(t))
        alone.take(*c, reads(c->channel.index, t), t);
    }

    ASSERT_GT(edges.size(), 100u);
    ASSERT_EQ(edges.size(), expected.size());
    for (std::size_t i = 0; i < edges.size(); ++i) {
      ASSERT_EQ(edges[i].at, expected[i].at);
      ASSERT_EQ(edges[i].valve.index, expected[i].valve.index);
      ASSERT_EQ(edges[i].open, expected[i].open);
    }
    const ControllerState &ours = b.board.controller()->state(), &theirs = alone.state();
    for (std::size_t j = 0; j < leg.joints; ++j) {
      EXPECT_EQ(ours.joint[j].angle_output, theirs.joint[j].angle_output);
      EXPECT_EQ(ours.joint[j].stiffness, theirs.joint[j].stiffness);
    }
    EXPECT_TRUE(b.fed);
    EXPECT_EQ(b.board.fault(), BoardFault::none);
  }
}

// --- the host -----------------------------------------------------------------------------------

TEST(Safety, AHostThatIsSilentFor100MillisecondsHoldsAndForASecondVents) {
  SupervisedBench b;
  b.start();
  b.run(999);
  const Tick last = b.now - 100;  // it commands at every 100th tick; the last one was then
  b.commands = false;
  ASSERT_TRUE(b.reaches(BoardState::hold, 2'000));
  EXPECT_LE(b.entered - last, 1'000 + 1);
  b.run(2);
  EXPECT_EQ(b.open, 0u);
  EXPECT_EQ(b.board.fault(), BoardFault::host_silent);
  ASSERT_TRUE(b.reaches(BoardState::vent, 20'000));
  EXPECT_LE(b.entered - last, 10'000 + 1);
  EXPECT_EQ(b.open & leg_inlets, 0u);
  EXPECT_EQ(b.open & leg_exhausts, leg_exhausts);
  EXPECT_EQ(b.board.controller()->supervised().trip.cause, Trip::Cause::host);
  ASSERT_TRUE(b.reaches(BoardState::fault, 20'000));
  EXPECT_EQ(b.open, 0u);
  b.commands = true;
  b.run(3'000);
  EXPECT_EQ(b.board.state(), BoardState::fault) << "there is no way back by commands";
}

TEST(Safety, AHostThatComesBackFromAHoldGoesOn) {
  SupervisedBench b;
  b.start();
  b.run(1'000);
  b.commands = false;
  ASSERT_TRUE(b.reaches(BoardState::hold, 2'000));
  b.commands = true;
  ASSERT_TRUE(b.reaches(BoardState::running, 101));
  EXPECT_EQ(b.board.fault(), BoardFault::none);
  b.run(300);
  EXPECT_GT(b.changed_at, b.entered);
}

TEST(Safety, ThreeBadCommandsHoldAndSixVent) {
  SupervisedBench b;
  b.start();
  b.run(499);
  b.command.joint[hip].stiffness = std::numeric_limits<float>::quiet_NaN();
  const Tick first = b.now + 100 - b.board.run_tick(b.now) % 100;
  ASSERT_TRUE(b.reaches(BoardState::hold, 1'000));
  EXPECT_LE(b.entered - first, 201);
  EXPECT_EQ(b.board.fault(), BoardFault::supervisor);
  b.run(2);
  EXPECT_EQ(b.open, 0u);
  ASSERT_TRUE(b.reaches(BoardState::vent, 1'000));
  EXPECT_LE(b.entered - first, 502);
}

TEST(Safety, AHoldLastsNoLongerThanTwoSeconds) {
  SupervisedBench b;
  b.start();
  b.commands = false;
  Command bad = b.command;
  bad.joint[hip].angle = 1'000'000;
  Tick held = -1;
  while (b.now < 60'000 && b.board.state() != BoardState::vent) {
    if (b.now % 9'000 == 0) b.board.command(bad, b.now);  // alive, but bad commands
    b.tick();
    if (held < 0 && b.board.state() == BoardState::hold) held = b.entered;
  }
  ASSERT_EQ(b.board.state(), BoardState::vent);
  EXPECT_EQ(b.board.fault(), BoardFault::held_too_long);
  EXPECT_EQ(b.entered - held, 20'000);
  EXPECT_EQ(b.board.controller()->supervised().trip.cause, Trip::Cause::held);
}

TEST(Safety, ShutDownVentsInTheSameTickAndEndsIdle) {
  SupervisedBench b;
  b.start();
  b.run(1'234);
  b.board.shut_down(b.now);
  b.tick();
  EXPECT_EQ(b.board.state(), BoardState::vent);
  EXPECT_EQ(b.open & leg_inlets, 0u);
  EXPECT_EQ(b.open & leg_exhausts, leg_exhausts);
  ASSERT_TRUE(b.reaches(BoardState::idle, 20'000));
  EXPECT_EQ(b.open, 0u);
  EXPECT_EQ(b.board.fault(), BoardFault::requested);
}

// --- random inputs ------------------------------------------------------------------------------

// Strictness of a state; in a run it may only increase, except at the end of a hold.
int depth(BoardState state) {
  switch (state) {
    case BoardState::running:
      return 0;
    case BoardState::hold:
      return 1;
    case BoardState::vent:
      return 2;
    default:
      return 3;
  }
}

TEST(Safety, WhateverComesAirGoesInOnlyWhileItRuns) {
  std::mt19937 random(3);
  const auto one_in = [&](unsigned n) { return random() % n == 0; };
  int runs = 0, holds = 0, vents = 0, dumps = 0, faults = 0;
  for (int trial = 0; trial < 30; ++trial) {
    SafetyConfig config;
    config.refractory = trial % 3 == 0 ? 2 : 0;
    if (trial % 4 == 1) config.empty_at[3] = 900;
    if (trial % 4 == 2) config.empty_at[3] = 100, config.vent_limit = 2'000;
    SupervisedBench b(config);
    b.replace_reading = [&](std::uint8_t, Tick, Reading r) {
      if (one_in(400)) r.counts = static_cast<std::uint16_t>(random() % 4096);
      if (one_in(400)) r.status = Status::late;
      return r;
    };
    bool talks = true;
    BoardState before = b.board.state();
    while (b.now < 60'000) {
      if (one_in(50)) b.board.clear(random() % 2, b.now);
      if (one_in(20)) b.board.arm_first(b.now);
      if (one_in(20)) b.board.arm_second(b.now);
      if (one_in(8'000)) b.board.shut_down(b.now);
      if (one_in(4'000)) talks = !talks;
      b.commands = talks;
      if (one_in(20)) b.command = any_command(random, test_leg(), one_in(30));
      if (one_in(3'000)) b.now += any_gap(random);
      b.tick();
      const BoardState state = b.board.state();
      if (state != BoardState::running) {
        ASSERT_EQ(b.open & leg_inlets, 0u) << static_cast<int>(state);
      }
      if (state != BoardState::running && state != BoardState::vent) {
        ASSERT_EQ(b.open, 0u) << static_cast<int>(state);
      }
      ASSERT_EQ(b.open & b.open >> 1 & 0x055, 0u) << "inlet and exhaust of one muscle";
      if (before == BoardState::fault || before == BoardState::dump) {
        ASSERT_TRUE(state == before || state == BoardState::idle || state == BoardState::armed);
      }
      if (depth(before) < 3 && depth(state) < depth(before)) {
        ASSERT_EQ(before, BoardState::hold);
      }
      runs += state == BoardState::running && before == BoardState::armed;
      holds += state == BoardState::hold && before != state;
      vents += state == BoardState::vent && before != state;
      dumps += state == BoardState::dump && before != state;
      faults += state == BoardState::fault && before != state;
      before = state;
    }
  }
  EXPECT_GT(runs, 25);
  EXPECT_GT(holds, 5);
  EXPECT_GT(vents, 15);
  EXPECT_GT(dumps, 1);
  EXPECT_GT(faults, 5);
}

}  // namespace
}  // namespace sinew::control::safety_test
