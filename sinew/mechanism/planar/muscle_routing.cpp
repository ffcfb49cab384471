#include "sinew/mechanism/planar/muscle_routing.h"

#include <algorithm>

#include "sinew/actuator/tension.h"
#include "sinew/robot/kinematics.h"

namespace sinew::plant {

CamLaw::CamLaw(const robot::Cam& cam, const robot::Joint& joint)
    : angle_(cam.angle), radius_(cam.radii), rest_(joint.rest_angle) {
  if (angle_.empty()) {
    angle_ = {joint.rest_angle};
    radius_ = {robot::cam_radius(cam, joint, joint.rest_angle)};
  }
  round_ = angle_.size() == 1;
  first_radius_ = radius_[0];
  area_ = {0.0};
  for (std::size_t k = 1; k < angle_.size(); ++k)
    area_.push_back(area_.back() +
                    0.5 * (radius_[k - 1] + radius_[k]) * (angle_[k] - angle_[k - 1]));
  area_at_rest_ = area(rest_);
}

double CamLaw::radius_of_table(double angle) const noexcept {
  return robot::cam_radius(angle_, radius_, angle);
}

double CamLaw::area(double angle) const noexcept {
  if (angle <= angle_.front()) return radius_.front() * (angle - angle_.front());
  for (std::size_t k = 1; k < angle_.size(); ++k) {
    if (angle > angle_[k]) continue;
    const double inside = angle - angle_[k - 1];
    return area_[k - 1] + 0.5 * (radius_[k - 1] + radius(angle)) * inside;
  }
  return area_.back() + radius_.back() * (angle - angle_.back());
}

double CamLaw::largest_radius() const noexcept { return *std::ranges::max_element(radius_); }

std::vector<double> muscle_damping(const Setup& setup) {
  std::vector<double> out(setup.robot.joints.size());
  for (std::size_t i = 0; i < setup.muscles.size(); ++i) {
    const robot::Muscle& m = setup.robot.muscles[i];
    const actuator::Actuator& a = setup.muscles[i].actuator;
    const bool empirical = a.short_end.law == actuator::ShortEnd::Law::empirical;
    const double damping = (empirical ? actuator::empirical_loss : 1.0) * a.loss.viscous;
    const auto add = [&](const std::string& joint, const robot::Cam& cam) {
      if (joint.empty()) return;
      const auto j = static_cast<std::size_t>(robot::find_joint(setup.robot, joint));
      const double r = CamLaw(cam, setup.robot.joints[j]).largest_radius();
      out[j] += setup.muscles[i].count * damping * r * r;
    };
    add(m.joint, m.cam);
    add(m.second.joint, m.second.cam);
  }
  return out;
}

MuscleRouting::MuscleRouting(const robot::Robot& robot) {
  const auto attach = [&](Route& route, int k, const std::string& name, robot::Muscle::Role role,
                          const robot::Cam& cam) {
    if (name.empty()) return;
    const auto at = static_cast<std::size_t>(k);
    route.joint[at] = robot::find_joint(robot, name);
    const robot::Joint& joint = robot.joints[static_cast<std::size_t>(route.joint[at])];
    const bool flexes = role == robot::Muscle::Role::flexor;
    route.sign[at] = flexes ? joint.sign() : -joint.sign();
    route.cam[at] = CamLaw(cam, joint);
  };
  for (const robot::Muscle& m : robot.muscles) {
    Route route{.mount = m.mount_length};
    attach(route, 0, m.joint, m.role, m.cam);
    attach(route, 1, m.second.joint, m.second.role, m.second.cam);
    routes_.push_back(route);
  }
  const auto is_round = [](const Route& route) {
    return route.joint[0] >= 0 && route.joint[1] < 0 && route.cam[0].round();
  };
  if (std::all_of(routes_.begin(), routes_.end(), is_round)) group_round_cams();
}

// Groups round cams into lanes. Lanes beyond the last muscle repeat it.
void MuscleRouting::group_round_cams() {
  constexpr std::size_t lanes = air::lanes;
  for (std::size_t first = 0; first < routes_.size(); first += lanes) {
    RoundRoutes& routes = round_.emplace_back();
    for (std::size_t k = 0; k < lanes; ++k) {
      const Route& route = routes_[std::min(first + k, routes_.size() - 1)];
      const double rest = route.cam[0].rest();
      routes.mount[k] = route.mount;
      routes.arm[k] = route.sign[0] * route.cam[0].radius(rest);
      routes.rest[k] = rest;
      routes.joint[k] = static_cast<std::size_t>(route.joint[0]);
    }
  }
}

}  // namespace sinew::plant
