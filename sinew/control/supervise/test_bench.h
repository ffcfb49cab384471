// control/supervise/test_bench.h - a board with a leg whose host and sensors a test controls.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <optional>

#include "sinew/control/supervise/safety.h"
#include "sinew/control/supervise/test_stand.h"

namespace sinew::control {

// Inlets (valves 4 x joint + 0, 2) and exhausts (1, 3) of test_leg's muscles and cylinder.
inline constexpr OpenMask leg_inlets = 0x555, leg_exhausts = 0xaaa;

struct SupervisedBench {
  explicit SupervisedBench(const SafetyConfig& safety = {},
                           const SuperviseConfig& sensors = limits(),
                           const JointControllerConfig& leg = test_leg()) {
    command = rest_command(leg);
    for (JointCommand& c : command.joint) {
      c.enabled = c.open_loop = true;  // valves open independent of the readings
      c.duties = {30, 0, 0, 30};
    }
    EXPECT_EQ(board.configure(leg, sensors, safety), nullptr);
  }

  // Runs one tick of the board.
  void tick() {
    board.begin(now);
    const bool starts = board.state() == BoardState::armed || board.starts_period(now);
    if (commands && starts) board.command(command, now);
    for (const signals::Edge& edge : board.edges(now))
      if (on_edge) on_edge(edge);
    if (const signals::Conversion* c = board.due(now)) {
      const std::uint8_t channel = c->channel.index;
      signals::Reading r{Stand::rest(channel), signals::Status::ok};
      if (replace_reading) r = replace_reading(channel, now, r);
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
  // Runs until a state is reached. Returns false if it was not reached in that many ticks.
  bool reaches(BoardState state, signals::Tick ticks) {
    for (const signals::Tick end = now + ticks; now < end && board.state() != state;) tick();
    return board.state() == state;
  }

  // Runs from power-up to the first command.
  void start() {
    board.clear(false, now);
    run(200);  // a scan, so that the sensors are good
    EXPECT_TRUE(board.clear(true, now));
    run(1'100);  // a complete check of the parameters
    EXPECT_TRUE(board.arm_first(now));
    EXPECT_TRUE(board.arm_second(now));
    commands = true;
    run(1);
    EXPECT_EQ(board.state(), BoardState::running);
  }

  Safety board;
  Command command;
  bool commands = false;  // the host sends a command for each period
  std::function<signals::Reading(std::uint8_t channel, signals::Tick, signals::Reading)>
      replace_reading;
  std::function<void(const signals::Edge&)> on_edge;
  signals::Tick now = 0;
  OpenMask open = 0;
  signals::Tick changed_at = 0;  // tick of the valves' last change
  bool fed = false;              // the watchdog was fed in the last tick
  BoardState last = BoardState::fault;
  signals::Tick entered = 0;  // tick at which the last state began
};

}  // namespace sinew::control
