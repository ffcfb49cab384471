// run/card/plan_table.h - a plan whose commands do not depend on measured values, as a table: its
// commands in each period are computed before the runs.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "sinew/control/joint/command.h"
#include "sinew/experiment/experiment.h"
#include "sinew/run/controllers/controllers.h"
#include "sinew/signals/tick.h"

namespace sinew::run {

// Returns whether a plan's commands depend on measured values: a phase ends when a value reaches a
// level, or follows the ground's force.
bool measures(const gait::Plan& plan);

// Returns a robot with the numbers that its gait controller uses; all others, of its body, air and
// sensors, are 0. Robots that are equal then have equal plan tables.
robot::Robot as_controlled(robot::Robot robot);

class PlanTable {
 public:
  static constexpr std::size_t row_size = sizeof(control::Command) + sizeof(gait::Desired);

  // Takes an experiment, whose plan must not measure, with its controllers at their start. The
  // robot must have one leg and one board.
  PlanTable(const experiment::Experiment& experiment, const Controllers& controllers);

  // Returns the commands of the board in each period of the low level.
  const std::vector<control::Command>& commands() const { return commands_; }
  // Returns the first tick at which the plan has finished and vents; the largest tick if it never
  // does.
  signals::Tick vents_at() const { return vents_at_; }
  // Returns the leg's setpoints in the period of a tick.
  const gait::Desired& desired_at(signals::Tick t) const {
    return desired_[static_cast<std::size_t>(t / period_)];
  }
  // Returns the number of the plan's periods with a point that the leg cannot reach.
  std::int64_t unreachable_periods() const { return unreachable_periods_; }

 private:
  signals::Tick period_;
  signals::Tick vents_at_ = std::numeric_limits<signals::Tick>::max();
  std::vector<control::Command> commands_;
  std::vector<gait::Desired> desired_;
  std::int64_t unreachable_periods_ = 0;
};

}  // namespace sinew::run
