// control/supervise/test_bench.h - a board with a leg on it, whose host and sensors do as a test
// wants.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <optional>

#include "sinew/control/supervise/safety.h"
#include "sinew/control/supervise/test_stand.h"

namespace sinew::control {

// Every inlet and every exhaust of test_leg's muscles and cylinder: valves 4 x joint + 0, 2 and
// 1, 3.
inline constexpr OpenMask leg_inlets = 0x555, leg_exhausts = 0xaaa;

struct SupervisedBench {
  explicit SupervisedBench(const SafetyConfig& safety = {},
                           const SuperviseConfig& sensors = limits(),
                           const JointControllerConfig& leg = test_leg()) {
    command = rest_command(leg);
    for (JointCommand& c : command.joint) {
      c.enabled = c.open_loop = true;  // valves work, whatever the readings are
      c.duties = {30, 0, 0, 30};
    }
    EXPECT_EQ(board.configure(leg, sensors, safety), nullptr);
  }

  // One tick of the board.
  void tick() {
    board.begin(now);
    const bool starts = board.state() == BoardState::armed || board.starts_period(now);
    if (commands && starts) board.command(command, now);
    for (const signals::Edge& edge : board.edges(now))
      if (on_edge) on_edge(edge);
    if (const signals::Conversion* c = board.due(now)) {
      const std::uint8_t channel = c->channel.index;
      signals::Reading r{Stand::rest(channel), signals::Status::ok};
      if (lie) r = lie(channel, now, r);
      board.take(*c, r, now);
    }
    const OpenMask before = open;
    open = board.open(now);
    if (open != before) changed_at = now;
    fed = board.end(now);
    if (board.state() != last) {
      last = board.state();
      entered = now;
    }
    ++now;
  }
  void run(signals::Tick ticks) {
    for (const signals::Tick end = now + ticks; now < end;) tick();
  }
  // Until a state is reached; false: it was not, in so many ticks.
  bool reaches(BoardState state, signals::Tick ticks) {
    for (const signals::Tick end = now + ticks; now < end && board.state() != state;) tick();
    return board.state() == state;
  }

  // From power-up to the first command.
  void start() {
    board.clear(false, now);
    run(200);  // a scan, for sensors that can be trusted
    EXPECT_TRUE(board.clear(true, now));
    run(1'100);  // the parameters are known
    EXPECT_TRUE(board.arm_first(now));
    EXPECT_TRUE(board.arm_second(now));
    commands = true;
    run(1);
    EXPECT_EQ(board.state(), BoardState::running);
  }

  Safety board;
  Command command;
  bool commands = false;  // the host sends one for each period
  std::function<signals::Reading(std::uint8_t channel, signals::Tick, signals::Reading)> lie;
  std::function<void(const signals::Edge&)> on_edge;
  signals::Tick now = 0;
  OpenMask open = 0;
  signals::Tick changed_at = 0;  // when the valves last did
  bool fed = false;              // the watchdog, in the last tick
  BoardState last = BoardState::fault;
  signals::Tick entered = 0;  // when the last state began
};

}  // namespace sinew::control
