// run/controllers/high_level.h - joins gait controllers and joint controllers: SI units on one
// side, counts on the other; joints and muscles of each leg on one side, of the machine on the
// other.
#pragma once

#include <array>
#include <span>

#include "sinew/control/gait/legs.h"
#include "sinew/robot/robot.h"
#include "sinew/run/controllers/boards.h"
#include "sinew/run/controllers/changes.h"

namespace sinew::run {

// Value of one count, and of one of the joint controller's stiffness units, as the controller
// assumes them. A channel is -1 if there is no sensor.
struct AssumedScales {
  std::array<double, robot::max_joints> rest{}, counts_per_rad{}, counts_at_rest{};
  std::array<double, robot::max_muscles> newtons_per_count{}, counts_at_zero{};
  std::array<int, robot::max_joints> angle_channel{};
  std::array<int, robot::max_muscles> tension_channel{};
  double cylinder_counts_per_metre = 0, cylinder_at_rest = 0;
  int cylinder_channel = -1;
};

class HighLevel {
 public:
  // `steering` may be null.
  HighLevel(const robot::Robot& robot, const gait::Plan& plan, Steering* steering = nullptr);

  // Returns the commands of a low-level period. The gait controller itself is updated once per
  // `high_level_period`.
  const MachineCommand& update(const MachineState& state, signals::Tick t) noexcept;
  // Returns whether the body is to be vented now. A plan that ends without a vent holds its last
  // setpoints until the run's end.
  bool finished() const noexcept { return vents_ && legs_.finished(); }

  // Returns the gait controllers of all legs.
  const gait::Legs& legs() const noexcept { return legs_; }
  // Returns the setpoints of each leg, with all changes applied, as they were passed on.
  std::span<const gait::Desired> desired() const noexcept {
    return {desired_.data(), legs_.count()};
  }
  const Changes& changes() const noexcept { return changes_; }

  // Returns the measured values for the gait controller, by the assumed scales.
  gait::MachineMeasured measure(const MachineState& state) const noexcept;

  // Requests a change; see Changes::request_change().
  bool request_change(const Steering::Request& request) noexcept {
    return changes_.request_change(request);
  }

  // Returns the settings that can be changed, by number.
  const std::vector<gait::Setting>& settings() const noexcept { return changes_.settings(); }

  // The complete state apart from later inputs, copied as bytes.
  struct State {
    gait::Legs::State legs;
    Changes::State changes;
    std::array<gait::Desired, robot::max_legs> desired;
    MachineCommand command;
  };
  State state() const noexcept { return {legs_.state(), changes_.state(), desired_, command_}; }
  void restore(const State& state) noexcept;

 private:
  void translate(const gait::Desired& desired, const robot::LegParts& leg) noexcept;
  void move_cylinder(const gait::Desired& desired) noexcept;

  int joints_, muscles_;
  bool vents_;
  bool has_cylinder_;
  float cylinder_gain_;  // [%/count]
  signals::Tick gait_period_ticks_;
  AssumedScales scale_;
  gait::Legs legs_;
  Changes changes_;
  std::array<gait::Desired, robot::max_legs> desired_;  // one per leg
  MachineCommand command_;
};

}  // namespace sinew::run
