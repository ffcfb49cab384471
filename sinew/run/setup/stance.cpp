#include "sinew/run/setup/stance.h"

#include <array>
#include <cmath>
#include <numbers>

#include "sinew/actuator/body.h"
#include "sinew/air/lanes.h"
#include "sinew/mechanism/planar/muscle_routing.h"
#include "sinew/robot/actuator_of.h"

namespace sinew::run {

namespace {

// Returns the angle, less whole turns, next to the joint's rest: from there it turns  [rad].
double next_to_rest(const robot::Joint& joint, double angle) {
  return joint.rest_angle + std::remainder(angle - joint.rest_angle, 2 * std::numbers::pi);
}

}  // namespace

Stance stance(const experiment::Experiment& e, const std::vector<double>& angles) {
  Stance out{.angles = angles, .foot = robot::forward(e.robot, angles).foot()};
  std::array<double, robot::max_joints> turned{}, still{};
  for (std::size_t j = 0; j < angles.size(); ++j)
    turned[j] = next_to_rest(e.robot.joints[j], angles[j]);
  air::Lanes<plant::most_muscles> length, rate;
  plant::MuscleRouting::MomentArms<plant::most_muscles> arms;
  plant::MuscleRouting(e.robot).at(turned.data(), still.data(), length, rate, arms);
  for (std::size_t i = 0; i < e.robot.muscles.size(); ++i) {
    const actuator::Actuator a = robot::actuator_of(e.robot.muscles[i], e.actuators);
    out.muscles.push_back({.name = e.robot.muscles[i].name,
                           .length = length[static_cast<int>(i)],
                           .shortest = actuator::shortest_length(a),
                           .longest = a.long_end.length});
  }
  if (robot::is_leg(e.robot))
    out.jacobian = robot::jacobian(robot::two_links(e.robot), angles[0], angles[1]);
  return out;
}

}  // namespace sinew::run
