#include "sinew/run/card/plan_table.h"

#include <algorithm>

namespace sinew::run {

using signals::Tick;

bool measures(const gait::Plan& plan) {
  return std::ranges::any_of(plan.phases, [](const gait::Phase& phase) {
    return !phase.until.measure.empty() || phase.ground_force.given();
  });
}

robot::Robot as_controlled(robot::Robot robot) {
  robot.trolley = {.present = robot.trolley.present};
  robot.ground = {.present = robot.ground.present};
  robot.rollers = {};
  robot.foot.mass = robot.foot.friction = 0;
  for (robot::Link& link : robot.links) link.mass = link.inertia = link.center_of_mass = 0;
  for (robot::Joint& joint : robot.joints) {
    joint.dry_friction = joint.damping = joint.damper = joint.spring = joint.spring_angle = 0;
    joint.stop = {};
  }
  for (robot::Muscle& muscle : robot.muscles) {
    muscle.mount_length = muscle.external_volume = 0;
    muscle.bladder_stiffness = muscle.bladder_rest_length = 0;
    muscle.hose = {};
    muscle.leak = {};
  }
  for (robot::Sensor& sensor : robot.sensors) sensor.scale = sensor.at_rest = sensor.noise = 0;
  return robot;
}

PlanTable::PlanTable(const experiment::Experiment& e, const Controllers& controllers)
    : period_(controllers.scan().period) {
  HighLevel high(as_controlled(e.robot), e.plan);
  const MachineState at_rest = controllers.boards().state();
  const Board& board = controllers.boards().each().front();
  const Tick last = experiment::last_tick(e);
  const auto rows = static_cast<std::size_t>(last / period_ + 1);
  commands_.reserve(rows);
  desired_.reserve(rows);
  for (Tick t = 0; t < last; t += period_) {
    commands_.push_back(board.own(high.update(at_rest, t)));
    desired_.push_back(high.desired().front());
    if (high.finished()) vents_at_ = std::min(vents_at_, t);
  }
  unreachable_periods_ = high.legs().unreachable_periods();
}

}  // namespace sinew::run
