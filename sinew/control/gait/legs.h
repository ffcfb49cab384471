// control/gait/legs.h - one gait controller per leg, and what coordinates them.
//
// Every leg follows the sequence for itself, ahead of it by its offset (robot.h). What it knows is
// its own: angles, tensions and [75] of its own foot. What coordinates them is the plan's time: a
// leg that has ended a phase early stays at the start of its next one until all others are as far,
// so that the offsets last, whatever ends the phases.
//
// A robot without [leg.*] has one leg, which is all of it: nothing but its GaitController.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sinew/control/gait/gait_controller.h"
#include "sinew/control/gait/plan.h"
#include "sinew/robot/legs.h"
#include "sinew/robot/robot.h"

namespace sinew::gait {

using MachineMeasured = MeasuredOf<robot::max_joints, robot::max_muscles>;

class Legs {
 public:
  // contradictions(robot, plan) must be empty.
  Legs(const robot::Robot& robot, const Plan& plan);

  // At the start of brain period `period_index` (0, 1, 2, ...), with what the machine measures, in
  // the robot's order.
  void update(const MachineMeasured& machine, std::int64_t period_index) noexcept;

  // How many legs there are; and of one its parts, its brain, and what that wants.
  std::size_t count() const noexcept { return brains_.size(); }
  const robot::LegParts& parts(std::size_t leg) const noexcept { return parts_[leg]; }
  const GaitController& brain(std::size_t leg) const noexcept { return brains_[leg]; }
  const Desired& desired(std::size_t leg) const noexcept { return brains_[leg].desired(); }

  // Everything that their next words depend on, beside the plan and what they will be told; of legs
  // that are not there, the default. Copied like bytes.
  using State = std::array<GaitController::State, robot::max_legs>;
  State state() const noexcept;
  void restore(const State& state) noexcept;  // of legs with an equal plan

  // All of them.
  bool finished() const noexcept;
  std::int64_t unreachable_periods() const noexcept;

 private:
  Measured of_leg(const MachineMeasured& machine, const robot::LegParts& leg) const noexcept;

  std::vector<robot::LegParts> parts_;
  std::vector<GaitController> brains_;
};

}  // namespace sinew::gait
