#include "sinew/robot/robot.h"

#include <algorithm>
#include <cmath>

#include "sinew/robot/legs.h"

namespace sinew::robot {
namespace {

template <class List, class Test>
int position(const List& list, Test test) {
  const auto found = std::find_if(list.begin(), list.end(), test);
  return found == list.end() ? -1 : static_cast<int>(found - list.begin());
}

template <class List>
int find(const List& list, std::string_view name) {
  return position(list, [&](const auto& item) { return item.name == name; });
}

int sensor_of(const Robot& robot, Sensor::Kind kind, std::string_view of) {
  return position(robot.sensors, [&](const Sensor& s) { return s.kind == kind && s.of == of; });
}

}  // namespace

int find_joint(const Robot& robot, std::string_view name) { return find(robot.joints, name); }
int find_muscle(const Robot& robot, std::string_view name) { return find(robot.muscles, name); }
int find_sensor(const Robot& robot, std::string_view name) { return find(robot.sensors, name); }

int muscle_of(const Robot& robot, int joint, Muscle::Role role) {
  const std::string& name = robot.joints[static_cast<std::size_t>(joint)].name;
  return position(robot.muscles, [&](const Muscle& m) {
    return (m.joint == name && m.role == role) || (m.second.joint == name && m.second.role == role);
  });
}

int angle_sensor_of(const Robot& robot, int joint) {
  return sensor_of(robot, Sensor::Kind::angle, robot.joints[static_cast<std::size_t>(joint)].name);
}

int tension_sensor_of(const Robot& robot, int muscle) {
  return sensor_of(robot, Sensor::Kind::tension,
                   robot.muscles[static_cast<std::size_t>(muscle)].name);
}

int pressure_sensor_of(const Robot& robot, int muscle) {
  return sensor_of(robot, Sensor::Kind::pressure,
                   robot.muscles[static_cast<std::size_t>(muscle)].name);
}

int velocity_sensor_of(const Robot& robot, int joint) {
  return sensor_of(robot, Sensor::Kind::velocity,
                   robot.joints[static_cast<std::size_t>(joint)].name);
}

int cylinder_sensor(const Robot& robot) {
  return position(robot.sensors, [](const Sensor& s) { return s.kind == Sensor::Kind::cylinder; });
}

bool needs_tension(const Robot& robot, int muscle) {
  using enum StiffnessSource;
  for (int j = 0; j < static_cast<int>(robot.joints.size()); ++j) {
    const Joint& joint = robot.joints[static_cast<std::size_t>(j)];
    const bool flexor = muscle_of(robot, j, Muscle::Role::flexor) == muscle;
    const bool extensor = muscle_of(robot, j, Muscle::Role::extensor) == muscle;
    const StiffnessSource from = joint.stiffness_source;
    if ((flexor || extensor) && (from == forces || joint.velocity.tensions)) return true;
    if ((flexor && from == flexor_force) || (extensor && from == extensor_force)) return true;
  }
  return false;
}

int parent_of(const Robot& robot, std::size_t link) {
  const std::string& name = robot.links[link].parent;
  if (name.empty()) return static_cast<int>(link) - 1;
  if (name == body_name) return -1;
  const int found = find(robot.links, name);
  return found < 0 ? -2 : found;
}

double attachment_of(const Robot& robot, std::size_t link) {
  if (std::isfinite(robot.links[link].at)) return robot.links[link].at;
  const int parent = parent_of(robot, link);
  return parent < 0 ? 0.0 : robot.links[static_cast<std::size_t>(parent)].length;
}

bool is_serial(const Robot& robot) {
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    const double end = i > 0 ? robot.links[i - 1].length : 0.0;
    if (parent_of(robot, i) != static_cast<int>(i) - 1 || attachment_of(robot, i) != end)
      return false;
  }
  return robot.legs.size() <= 1;
}

bool is_plain(const Robot& robot) {
  const auto round = [](const Cam& cam) { return cam.angle.empty() && !(cam.radius > 0); };
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    const Joint& j = robot.joints[i];
    if (j.kind == Joint::Kind::passive || j.damper != 0 || j.spring != 0) return false;
    for (const auto role : {Muscle::Role::flexor, Muscle::Role::extensor})
      if (muscle_of(robot, static_cast<int>(i), role) < 0) return false;
  }
  for (const Muscle& m : robot.muscles)
    if (!m.second.joint.empty() || !round(m.cam)) return false;
  for (const Sensor& s : robot.sensors)
    if (s.kind == Sensor::Kind::pressure || s.kind == Sensor::Kind::velocity) return false;
  return robot.joints.size() <= 2 && is_serial(robot) && robot.foot.points.empty() &&
         (!robot.cylinder.present || robot.cylinder.mode == Cylinder::Mode::locked);
}

bool is_chain(const Robot& robot) {
  for (const Muscle& m : robot.muscles)
    if (!m.second.joint.empty() || !m.cam.angle.empty()) return false;
  return !robot.joints.empty() && robot.joints.size() <= 2 && is_serial(robot) &&
         robot.foot.points.empty() &&
         (!robot.cylinder.present || robot.cylinder.mode == Cylinder::Mode::locked);
}

double leg_mass(const Robot& robot) {
  double mass = 0;
  for (std::size_t l = 0; l < std::max<std::size_t>(1, robot.legs.size()); ++l)
    if (const Foot& foot = foot_of(robot, l); foot.present) mass += foot.mass;
  for (const Link& link : robot.links) mass += link.mass;
  return mass;
}

double trolley_own_mass(const Robot& robot) {
  if (!robot.trolley.present) return 0.0;
  const double body = robot.cylinder.present ? robot.cylinder.body_mass : 0.0;
  return robot.trolley.total_mass - leg_mass(robot) - body;
}

}  // namespace sinew::robot
