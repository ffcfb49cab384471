// control/gait/legs.h - coordination of several legs, each with its own gait controller.
//
// Every leg follows the sequence independently, ahead by its offset (robot.h), and uses only its
// own measurements: angles, tensions and [75] of its foot. The legs are coordinated by the plan's
// time: a leg that has ended a phase early waits at the start of its next one until all others have
// reached that time, so that the offsets are kept even if phases end early.
//
// A robot without [leg.*] has one leg, which is the whole robot and needs only a GaitController.
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
  // Requires that contradictions(robot, plan) is empty.
  Legs(const robot::Robot& robot, const Plan& plan);

  // Updates all legs at the start of the gait controller's period `period_index` (0, 1, 2,
  // ...) from the machine's measurements, in the robot's order.
  void update(const MachineMeasured& machine, std::int64_t period_index) noexcept;

  // Return the number of legs, and a leg's parts, gait controller and setpoints.
  std::size_t count() const noexcept { return controllers_.size(); }
  const robot::LegParts& parts(std::size_t leg) const noexcept { return parts_[leg]; }
  const GaitController& controller(std::size_t leg) const noexcept { return controllers_[leg]; }
  const Desired& desired(std::size_t leg) const noexcept { return controllers_[leg].desired(); }

  // Everything that the next setpoints depend on, apart from the plan and future measurements; for
  // legs that do not exist, the default. Trivially copyable.
  using State = std::array<GaitController::State, robot::max_legs>;
  State state() const noexcept;
  void restore(const State& state) noexcept;  // requires legs with an equal plan

  // Return whether all legs are finished, and the sum of their unreachable periods.
  bool finished() const noexcept;
  std::int64_t unreachable_periods() const noexcept;

 private:
  Measured of_leg(const MachineMeasured& machine, const robot::LegParts& leg) const noexcept;

  std::vector<robot::LegParts> parts_;
  std::vector<GaitController> controllers_;
};

}  // namespace sinew::gait
