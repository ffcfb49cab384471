#include "sinew/mechanism/planar/muscle_routing.h"

#include <algorithm>

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

MuscleRouting::MuscleRouting(const robot::Robot& robot) {
  const auto attach = [&](Route& cord, int k, const std::string& name, robot::Muscle::Role role,
                          const robot::Cam& cam) {
    if (name.empty()) return;
    const auto at = static_cast<std::size_t>(k);
    cord.joint[at] = robot::find_joint(robot, name);
    const robot::Joint& joint = robot.joints[static_cast<std::size_t>(cord.joint[at])];
    const bool flexes = role == robot::Muscle::Role::flexor;
    cord.sign[at] = flexes ? joint.sign() : -joint.sign();
    cord.cam[at] = CamLaw(cam, joint);
  };
  for (const robot::Muscle& m : robot.muscles) {
    Route cord{.mount = m.mount_length};
    attach(cord, 0, m.joint, m.role, m.cam);
    attach(cord, 1, m.second.joint, m.second.role, m.second.cam);
    cords_.push_back(cord);
  }
  const auto is_round = [](const Route& cord) {
    return cord.joint[0] >= 0 && cord.joint[1] < 0 && cord.cam[0].round();
  };
  if (std::all_of(cords_.begin(), cords_.end(), is_round)) lay_round_ones_side_by_side();
}

// Groups round cams into lanes. Lanes beyond the last muscle repeat it.
void MuscleRouting::lay_round_ones_side_by_side() {
  constexpr std::size_t lanes = air::lanes;
  for (std::size_t first = 0; first < cords_.size(); first += lanes) {
    RoundRoutes& routes = round_.emplace_back();
    for (std::size_t k = 0; k < lanes; ++k) {
      const Route& cord = cords_[std::min(first + k, cords_.size() - 1)];
      const double rest = cord.cam[0].rest();
      routes.mount[k] = cord.mount;
      routes.arm[k] = cord.sign[0] * cord.cam[0].radius(rest);
      routes.rest[k] = rest;
      routes.joint[k] = static_cast<std::size_t>(cord.joint[0]);
    }
  }
}

}  // namespace sinew::plant
