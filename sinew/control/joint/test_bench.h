// control/joint/test_bench.h - a joint controller with constant readings, for tests.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

#include "sinew/control/joint/joint_controller.h"
#include "sinew/control/joint/test_leg.h"

namespace sinew::control {

// Constant readings by channel, and the same command for all joints.
struct Bench {
  explicit Bench(const JointControllerConfig& config) : controller(config) {
    EXPECT_EQ(problem(config), nullptr);
    command = rest_command(config);
    for (JointCommand& c : command.joint) c.enabled = true;
    reading.fill(1000);
  }

  void run(int periods) {
    const signals::Tick end = now + periods * controller.config().period;
    for (; now < end; now = controller.next_event(now)) {
      if (controller.starts_period(now)) controller.command(command);
      for (const signals::Edge& e : controller.edges(now)) edges.push_back(e);
      if (const signals::Conversion* c = controller.due(now))
        controller.take(*c, {reading[c->channel.index], signals::Status::ok}, now);
    }
  }

  // Returns the share of time for which a valve was open in the last periods.
  double open_share(int valve, int periods) const {
    const signals::Tick from = now - periods * controller.config().period;
    double open = 0;
    signals::Tick since = from;
    bool on = false;
    for (const signals::Edge& e : edges) {
      if (e.valve.index != valve) continue;
      if (e.at > from && on) open += static_cast<double>(e.at - since);
      on = e.open, since = std::max(e.at, from);
    }
    if (on) open += static_cast<double>(now - since);
    return open / static_cast<double>(now - from);
  }

  JointController controller;
  Command command;
  std::array<std::uint16_t, max_channels> reading{};
  std::vector<signals::Edge> edges;
  signals::Tick now = 0;
};

inline JointControllerConfig leg_with(const std::function<void(JointControllerConfig&)>& change) {
  JointControllerConfig config = test_leg();
  change(config);
  return config;
}

}  // namespace sinew::control
