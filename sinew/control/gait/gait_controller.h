// control/gait/gait_controller.h - the high-level controller of a leg (thesis 5.1).
//
// Once per period it reads the low level's measurements and returns setpoints: joint angles from
// the foot path by [63], [64], stiffnesses, gains, or open-loop duties, and the cylinder's
// position. It may end a phase on any measured quantity, including the ground reaction that [75]
// derives from the tensions, and may adjust the path's height by that reaction.
//
// A foot path moves the first two joints; further joints are passive or have angles of their own.
//
//   settling (plan.settle) -> sequence, plan.repeat times -> finished (vent or hold)
//
// No heap, no exceptions in update(); double and SI throughout. The loop converts angles to counts.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sinew/control/gait/plan.h"
#include "sinew/robot/kinematics.h"
#include "sinew/robot/robot.h"

namespace sinew::gait {

// Measurements of the low level for a number of joints and muscles, in the robot's order.
template <int Joints, int Muscles>
struct MeasuredOf {
  std::array<double, Joints> angle{};      // [rad]
  std::array<double, Joints> velocity{};   // estimate of the low level [rad/s]
  std::array<double, Joints> stiffness{};  // [N m/rad]
  std::array<double, Muscles> tension{};   // [N]
  double cylinder = 0;                     // travel, from its sensor [m]
};

using Measured = MeasuredOf<robot::max_leg_joints, robot::max_leg_muscles>;

// Setpoints of a joint.
struct DesiredJoint {
  double angle = 0;      // [rad] 0 .. 2 pi
  double stiffness = 0;  // [N m/rad]
  robot::Gains gains;    // [1/count], [1/(N m/rad)], [s/count]
  bool enabled = false;
  bool open_loop = false;                           // duties replace the laws
  double flexor_inlet = 0, flexor_exhaust = 0;      // [-] 0 .. 1
  double extensor_inlet = 0, extensor_exhaust = 0;  // [-]
};

// Setpoints of the air cylinder, joint 0 of B.1.
struct DesiredCylinder {
  bool given = false;      // false: no phase has set a position yet, it stays at its extended stop
  double position = 0;     // travel, up from that stop [m]
  bool open_loop = false;  // duties replace the law
  double up_inlet = 0, up_exhaust = 0;      // [-] 0 .. 1
  double down_inlet = 0, down_exhaust = 0;  // [-]
};

// Progress of the plan.
enum class Stage : std::uint8_t { settling, walking, finished };

// Setpoints of a leg for one period.
struct Desired {
  std::array<DesiredJoint, robot::max_leg_joints> joint;
  DesiredCylinder cylinder;

  Stage stage = Stage::settling;
  bool vent = false;    // finished: every exhaust open, every inlet shut
  int step = 0;         // 0 .. repeat - 1
  int phase = -1;       // position in Plan::phases; -1 outside the sequence
  double progress = 0;  // s of the phase

  bool has_foot = false;     // the phase has a foot path
  robot::Point foot;         // current position, height corrected by the measured force [m]
  bool unreachable = false;  // the angles are those of the nearest reachable point
};

class GaitController {
 public:
  // Requires that contradictions(robot, plan) is empty. `offset` is the share of a step by which it
  // begins within the sequence; after all steps it ends at the same place.
  GaitController(const robot::Robot&, const Plan&, double offset = 0);

  // Returns the setpoints at the start of the gait controller's period `period_index` (0, 1, 2,
  // ...). The same index again returns the same. A leg that waits keeps its progress, even if its
  // phase should end.
  const Desired& update(const Measured&, std::int64_t period_index, bool waits = false) noexcept;

  // Returns the progress since the start, as if every phase had taken its planned time [periods of
  // the gait controller].
  std::int64_t planned_periods() const noexcept;

  // Return the setpoints of this period, whether the plan is finished, and the number of
  // periods in which the foot could not reach its path.
  const Desired& desired() const noexcept { return desired_; }
  bool finished() const noexcept { return desired_.stage == Stage::finished; }
  std::int64_t unreachable_periods() const noexcept { return unreachable_periods_; }

  // Returns the ground's force on the foot by [75] from the tensions [N]; zero at a singular pose.
  robot::Point ground_reaction(const Measured&) const noexcept;

  // Returns the plan that it follows.
  const Plan& plan() const noexcept { return plan_; }

  // Everything that the next setpoints depend on, apart from the plan and future measurements.
  // Trivially copyable.
  struct State {
    std::int64_t period = -1;  // last updated period
    std::size_t position = 0;  // in the sequence
    int k = 0;                 // period within the phase
    std::int64_t unreachable_periods = 0;
    Desired desired;
  };
  State state() const noexcept { return {period_, position_, k_, unreachable_periods_, desired_}; }
  // Requires the state of a controller with an equal plan.
  void restore(const State& s) noexcept {
    period_ = s.period;
    position_ = s.position;
    k_ = s.k;
    unreachable_periods_ = s.unreachable_periods;
    desired_ = s.desired;
  }

 private:
  // A phase at its position in the sequence.
  struct ScheduledPhase {
    int phase = 0;    // position in Plan::phases
    int periods = 1;  // at most
    int before = 0;   // longest sum of the periods before it in the step
    int steps = 1;    // periods from s = 0 to s = 1
    Measure measure;
    std::array<bool, robot::max_leg_joints> enabled{};
  };
  void advance(const Measured&) noexcept;
  void wait(const Measured&) noexcept;
  bool enter_next_phase() noexcept;
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
  std::vector<ScheduledPhase> sequence_;
  std::int64_t settle_periods_ = 0;
  std::size_t first_ = 0;  // position in sequence_ at the start
  int first_k_ = 0;        // period within that phase

  std::int64_t period_ = -1;  // last updated period
  std::size_t position_ = 0;  // in sequence_
  int k_ = 0;                 // period within the phase
  std::int64_t unreachable_periods_ = 0;
  Desired desired_;
};

}  // namespace sinew::gait
