#include "sinew/control/gait/gait_controller.h"

#include <algorithm>
#include <cmath>

#include "sinew/control/gait/path.h"

namespace sinew::gait {
namespace {

bool listed(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Returns the setpoints before the first phase: rest angles, as B.1 sets `thetades` to `potoffset`.
DesiredJoint at_rest(const robot::Joint& joint, const JointPlan& plan) {
  DesiredJoint desired;
  desired.angle = joint.rest_angle;
  desired.stiffness = plan.stiffness;
  desired.gains = plan.gains;
  return desired;
}

}  // namespace

GaitController::GaitController(const robot::Robot& robot, const Plan& plan, double offset)
    : plan_(plan),
      robot_(robot),
      leg_(robot::is_leg(robot)),
      settle_periods_(std::llround(plan.settle / plan.high_level_period)) {
  if (leg_) links_ = robot::two_links(robot);
  for (std::size_t i = 0; i < robot_.joints.size(); ++i)
    desired_.joint[i] = at_rest(robot_.joints[i], plan_.joints[i]);
  for (Phase& phase : plan_.phases) phase.joints.resize(robot_.joints.size());

  for (const std::string& name : plan_.sequence) {
    ScheduledPhase scheduled;
    scheduled.phase = find_phase(plan_, name);
    const Phase& phase = plan_.phases[static_cast<std::size_t>(scheduled.phase)];
    scheduled.periods = periods(plan_, phase);
    scheduled.steps = steps_of_s(plan_, phase);
    scheduled.before = sequence_.empty() ? 0 : sequence_.back().before + sequence_.back().periods;
    scheduled.measure = find_measure(robot, phase.until.measure);
    for (std::size_t i = 0; i < plan_.joints.size(); ++i) {
      const JointPlan& joint = plan_.joints[i];
      scheduled.enabled[i] = joint.enabled && !listed(phase.disabled, joint.name);
    }
    sequence_.push_back(scheduled);
  }
  if (sequence_.empty()) return;
  const int step = sequence_.back().before + sequence_.back().periods;
  const auto ahead = static_cast<int>(std::lround(offset * step)) % step;
  while (ahead >= sequence_[first_].before + sequence_[first_].periods) ++first_;
  first_k_ = ahead - sequence_[first_].before;
}

const Desired& GaitController::update(const Measured& measured, std::int64_t period_index,
                                      bool waits) noexcept {
  while (period_ < period_index && !finished()) {
    ++period_;
    waits ? wait(measured) : advance(measured);
  }
  return desired_;
}

std::int64_t GaitController::planned_periods() const noexcept {
  if (desired_.stage == Stage::settling || sequence_.empty()) return 0;
  const ScheduledPhase &here = sequence_[position_], &last = sequence_.back();
  const std::int64_t step = last.before + last.periods;
  return desired_.step * step + here.before + k_ - (sequence_[first_].before + first_k_);
}

void GaitController::wait(const Measured& measured) noexcept {
  describe(static_cast<double>(k_) / sequence_[position_].steps, measured);
  if (desired_.unreachable) ++unreachable_periods_;
}

// Enters the next phase. Returns false if the last step is over. A leg that began within a step has
// one more partial step.
bool GaitController::enter_next_phase() noexcept {
  if (position_ + 1 < sequence_.size()) {
    enter(position_ + 1);
    return true;
  }
  const bool began_within = first_ > 0 || first_k_ > 0;
  if (desired_.step + 1 >= plan_.repeat + (began_within ? 1 : 0)) return false;
  ++desired_.step;
  enter(0);
  return true;
}

// Returns whether, after all its steps, it is at the place where it began.
bool GaitController::is_back() const noexcept {
  if (desired_.step < plan_.repeat) return false;
  return position_ > first_ || (position_ == first_ && k_ >= first_k_);
}

void GaitController::advance(const Measured& measured) noexcept {
  if (period_ < settle_periods_) return;
  if (desired_.stage == Stage::settling) {
    desired_.stage = Stage::walking;
    if (sequence_.empty()) return finish();
    enter(first_);
    k_ = first_k_;
  } else {
    ++k_;
    const bool over = k_ >= sequence_[position_].periods;
    const bool early = !over && ended(measured);
    if (over || early) {
      leave(early, measured);
      if (!enter_next_phase()) return finish();
    }
    if (is_back()) return finish();
  }
  describe(static_cast<double>(k_) / sequence_[position_].steps, measured);
  if (desired_.unreachable) ++unreachable_periods_;
}

void GaitController::enter(std::size_t position) noexcept {
  position_ = position;
  k_ = 0;
  desired_.phase = sequence_[position].phase;
  for (std::size_t i = 0; i < robot_.joints.size(); ++i)
    desired_.joint[i].enabled = sequence_[position].enabled[i];
}

// A phase that was not ended early has reached s = 1, even if no period had that value.
void GaitController::leave(bool early, const Measured& measured) noexcept {
  if (!early) describe(1.0, measured);
}

void GaitController::finish() noexcept {
  desired_.stage = Stage::finished;
  desired_.vent = plan_.finish == Plan::Finish::vent;
  desired_.phase = -1;
  if (!desired_.vent) return;
  for (DesiredJoint& joint : desired_.joint) {
    joint.enabled = false;
    joint.open_loop = false;
  }
  desired_.cylinder.open_loop = false;
}

bool GaitController::ended(const Measured& measured) const noexcept {
  const ScheduledPhase& scheduled = sequence_[position_];
  if (scheduled.measure.kind == Measure::Kind::none) return false;
  const Until& until = plan_.phases[static_cast<std::size_t>(scheduled.phase)].until;
  const double now = value(scheduled.measure, measured);
  return until.is == Until::Is::above ? now > until.level : now < until.level;
}

double GaitController::value(const Measure& measure, const Measured& measured) const noexcept {
  const auto i = static_cast<std::size_t>(std::max(measure.index, 0));
  switch (measure.kind) {
    case Measure::Kind::normal_force:
      return ground_reaction(measured).y;
    case Measure::Kind::friction_force:
      return ground_reaction(measured).x;
    case Measure::Kind::angle:
      return measured.angle[i];
    case Measure::Kind::stiffness:
      return measured.stiffness[i];
    case Measure::Kind::tension:
      return measured.tension[i];
    case Measure::Kind::none:
    case Measure::Kind::unknown:
      break;
  }
  return std::nan("");  // compares as false with every level
}

// Sets all setpoints for progress s of the current phase.
void GaitController::describe(double s, const Measured& measured) noexcept {
  const Phase& phase = plan_.phases[static_cast<std::size_t>(desired_.phase)];
  desired_.progress = s;
  desired_.has_foot = phase.has_path() && leg_;
  desired_.unreachable = false;
  if (desired_.has_foot) follow_path(phase, s, measured);
  for (std::size_t i = 0; i < robot_.joints.size(); ++i) {
    DesiredJoint& joint = desired_.joint[i];
    set_joint(phase.joints[i], joint, s);
    joint.angle = within(plan_.joints[i].range, joint.angle);
  }
  set_cylinder(phase.cylinder, s);
}

void GaitController::follow_path(const Phase& phase, double s, const Measured& measured) noexcept {
  desired_.foot = foot_at(phase, s);
  if (phase.ground_force.given())
    desired_.foot.y += correction(phase.ground_force, ground_reaction(measured).y);
  const robot::Inverse inverse = robot::inverse(links_, desired_.foot);
  desired_.unreachable = !inverse.reached();
  if (inverse.status == robot::Inverse::Status::not_a_number) return;
  for (std::size_t i = 0; i < inverse.angle.size(); ++i) desired_.joint[i].angle = inverse.angle[i];
}

// Sets the cylinder. Without a position in the phase the last one is kept.
void GaitController::set_cylinder(const CylinderPhase& phase, double s) noexcept {
  DesiredCylinder& cylinder = desired_.cylinder;
  cylinder.open_loop = phase.feedforward.given();
  cylinder.up_inlet = value_at(phase.feedforward.flexor_inlet, s, 0);
  cylinder.up_exhaust = value_at(phase.feedforward.flexor_exhaust, s, 0);
  cylinder.down_inlet = value_at(phase.feedforward.extensor_inlet, s, 0);
  cylinder.down_exhaust = value_at(phase.feedforward.extensor_exhaust, s, 0);

  if (!phase.placed()) return;
  cylinder.given = true;
  if (phase.polynomial.empty()) {
    cylinder.position = value_at(phase.position, s, cylinder.position);
  } else {
    const double u = phase.of == CylinderPhase::Of::foot_y ? desired_.foot.y : s;
    cylinder.position = polynomial_at(phase.polynomial, u);
  }
}

void GaitController::set_joint(const JointPhase& phase, DesiredJoint& joint,
                               double s) const noexcept {
  if (!phase.angle.empty()) joint.angle = robot::normalised(value_at(phase.angle, s, 0));
  joint.stiffness = value_at(phase.stiffness, s, joint.stiffness);
  joint.gains.angle = value_at(phase.gains.angle, s, joint.gains.angle);
  joint.gains.stiffness = value_at(phase.gains.stiffness, s, joint.gains.stiffness);
  joint.gains.velocity = value_at(phase.gains.velocity, s, joint.gains.velocity);

  joint.open_loop = phase.feedforward.given();
  joint.flexor_inlet = value_at(phase.feedforward.flexor_inlet, s, 0);
  joint.flexor_exhaust = value_at(phase.feedforward.flexor_exhaust, s, 0);
  joint.extensor_inlet = value_at(phase.feedforward.extensor_inlet, s, 0);
  joint.extensor_exhaust = value_at(phase.feedforward.extensor_exhaust, s, 0);
}

robot::Point GaitController::ground_reaction(const Measured& measured) const noexcept {
  if (!leg_) return {};
  std::array<double, 2> torque{};
  for (std::size_t i = 0; i < torque.size(); ++i)
    torque[i] =
        robot::torque_of_muscles(robot_, static_cast<int>(i), measured.angle[i], measured.tension);
  return robot::ground_reaction(links_, measured.angle[0], measured.angle[1], torque).force;
}

}  // namespace sinew::gait
