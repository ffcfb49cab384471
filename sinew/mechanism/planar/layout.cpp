#include "sinew/mechanism/planar/layout.h"

#include "sinew/robot/kinematics.h"

namespace sinew::plant {

ChainRouting chain_routing_of(const robot::Robot& robot) {
  ChainRouting s;
  for (const robot::Muscle& m : robot.muscles) {
    const int i = s.count++;
    s.joint[i] = robot::find_joint(robot, m.joint);
    const robot::Joint& joint = robot.joints[static_cast<std::size_t>(s.joint[i])];
    const double role = m.role == robot::Muscle::Role::flexor ? 1.0 : -1.0;
    s.mount[i] = m.mount_length;
    s.moment_arm[i] = role * joint.sign() * robot::cam_radius(m.cam, joint, joint.rest_angle);
  }
  s.padded = (s.count + air::lanes - 1) / air::lanes * air::lanes;
  for (int i = s.count; i < s.padded; ++i) {
    s.joint[i] = s.joint[s.count - 1];
    s.mount[i] = s.mount[s.count - 1];
    s.moment_arm[i] = s.moment_arm[s.count - 1];
  }
  return s;
}

}  // namespace sinew::plant
