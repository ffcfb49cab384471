// control/gait/gait_controller.h - the high-level controller, the "brain" of 5.1.
//
// Once per brain period it reads what the low level believes and says what it wants: joint angles
// from the foot path by [63], [64], stiffnesses, gains, or open-loop duties, and the cylinder's
// place. It may end a phase on any measured quantity, also on the ground reaction that [75] makes
// of the tensions, and may let that reaction set the path's height.
//
// A foot path moves the first two joints; what follows them is passive, or has its own angles.
//
//   settling (plan.settle) -> sequence, plan.repeat times -> finished (vent or hold)
//
// No heap, no exceptions in update(); double and SI throughout. The loop turns angles into counts.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sinew/control/gait/plan.h"
#include "sinew/robot/kinematics.h"
#include "sinew/robot/robot.h"

namespace sinew::gait {

// Holds what the low level believes of so many joints and muscles, in the robot's order.
template <int Joints, int Muscles>
struct MeasuredOf {
  std::array<double, Joints> angle{};      // [rad]
  std::array<double, Joints> velocity{};   // as the low level estimates it [rad/s]
  std::array<double, Joints> stiffness{};  // [N m/rad]
  std::array<double, Muscles> tension{};   // [N]
  double cylinder = 0;                     // travel, by its sensor [m]
};

using Measured = MeasuredOf<robot::max_leg_joints, robot::max_leg_muscles>;

// Holds what the brain wants of a joint.
struct DesiredJoint {
  double angle = 0;      // [rad] 0 .. 2 pi
  double stiffness = 0;  // [N m/rad]
  robot::Gains gains;    // [1/count], [1/(N m/rad)], [s/count]
  bool enabled = false;
  bool open_loop = false;                           // the duties in place of the laws
  double flexor_inlet = 0, flexor_exhaust = 0;      // [-] 0 .. 1
  double extensor_inlet = 0, extensor_exhaust = 0;  // [-]
};

// Of the air cylinder, joint 0 of B.1.
struct DesiredCylinder {
  bool given = false;   // false: no phase has asked for a place yet, it stays at its extended stop
  double position = 0;  // travel, up from that stop [m]
  bool open_loop = false;                   // the duties in place of the law
  double up_inlet = 0, up_exhaust = 0;      // [-] 0 .. 1
  double down_inlet = 0, down_exhaust = 0;  // [-]
};

// How far the plan is.
enum class Stage : std::uint8_t { settling, walking, finished };

// The brain's word for a leg, for one period.
struct Desired {
  std::array<DesiredJoint, robot::max_leg_joints> joint;
  DesiredCylinder cylinder;

  Stage stage = Stage::settling;
  bool vent = false;    // finished: every exhaust open, every inlet shut
  int step = 0;         // 0 .. repeat - 1
  int phase = -1;       // position in Plan::phases; -1 outside the sequence
  double progress = 0;  // s of the phase

  bool has_foot = false;     // the phase has a foot path
  robot::Point foot;         // where it is now, height corrected by the measured force [m]
  bool unreachable = false;  // the angles are those of the nearest point that can be reached
};

class GaitController {
 public:
  // contradictions(robot, plan) must be empty. `offset` is the share of a step by which it begins
  // within the sequence; it ends where it began, after as many whole steps.
  GaitController(const robot::Robot&, const Plan&, double offset = 0);

  // At the start of brain period `period_index` (0, 1, 2, ...). The same index again gives the
  // same. A leg that waits stays where it is in its phase, whatever ends it.
  const Desired& update(const Measured&, std::int64_t period_index, bool waits = false) noexcept;

  // How far it is, as if every phase had taken the time that the plan gives it; from where it began
  // [brain periods].
  std::int64_t planned_periods() const noexcept;

  // Returns its word for this period; whether its plan is over; in how many periods the foot could
  // not reach its path.
  const Desired& desired() const noexcept { return desired_; }
  bool finished() const noexcept { return desired_.stage == Stage::finished; }
  std::int64_t unreachable_periods() const noexcept { return unreachable_periods_; }

  // [75] from the tensions  [N], on the foot by the ground; no force at a singular pose.
  robot::Point ground_reaction(const Measured&) const noexcept;

  // Returns what it follows.
  const Plan& plan() const noexcept { return plan_; }

  // Everything that its next word depends on, beside its plan and what it will be told. Copied like
  // bytes.
  struct State {
    std::int64_t period = -1;  // the last one answered
    std::size_t position = 0;  // in the sequence
    int k = 0;                 // period within the phase
    std::int64_t unreachable_periods = 0;
    Desired desired;
  };
  State state() const noexcept { return {period_, position_, k_, unreachable_periods_, desired_}; }
  // Expects the state of a brain with an equal plan.
  void restore(const State& s) noexcept {
    period_ = s.period;
    position_ = s.position;
    k_ = s.k;
    unreachable_periods_ = s.unreachable_periods;
    desired_ = s.desired;
  }

 private:
  // A phase in its place of the sequence.
  struct Slot {
    int phase = 0;    // position in Plan::phases
    int periods = 1;  // at most
    int before = 0;   // periods of the step before it, at most
    int steps = 1;    // periods from s = 0 to s = 1
    Measure measure;
    std::array<bool, robot::max_leg_joints> enabled{};
  };
  void advance(const Measured&) noexcept;
  void wait(const Measured&) noexcept;
  bool go_on() noexcept;
  bool is_back() const noexcept;
  void enter(std::size_t position) noexcept;
  void leave(bool early, const Measured&) noexcept;
  void finish() noexcept;
  bool ended(const Measured&) const noexcept;
  double value(const Measure&, const Measured&) const noexcept;

  void describe(double s, const Measured&) noexcept;
  void follow_path(const Phase&, double s, const Measured&) noexcept;
  void set_joint(const JointPhase&, DesiredJoint&, double s) const noexcept;
  void set_cylinder(const CylinderPhase&, double s) noexcept;

  Plan plan_;
  robot::Robot robot_;
  robot::TwoLinks links_;
  bool leg_ = false;
  std::vector<Slot> sequence_;
  std::int64_t settle_periods_ = 0;
  std::size_t first_ = 0;  // position in sequence_ at which it begins
  int first_k_ = 0;        // period within that phase

  std::int64_t period_ = -1;  // the last one answered
  std::size_t position_ = 0;  // in sequence_
  int k_ = 0;                 // period within the phase
  std::int64_t unreachable_periods_ = 0;
  Desired desired_;
};

}  // namespace sinew::gait
