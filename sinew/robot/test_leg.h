// robot/test_leg.h - the parts of the thesis's leg that tests need: lengths, joints, pairs and
// scan of 4.2, 5.3, B.1. The whole leg is robots/leg.
#pragma once

#include <numbers>

#include "sinew/robot/robot.h"

namespace sinew::robot::test {

inline constexpr double inch = 0.0254;
inline constexpr double degree = std::numbers::pi / 180.0;

inline void add_joint(Robot& robot, const std::string& name, double rest, Joint::Flexion flexion) {
  Joint joint;
  joint.name = name;
  joint.rest_angle = rest;
  joint.flexion = flexion;
  joint.moment_arm = 1.0 * inch;
  joint.gains = {.angle = 0.001, .stiffness = 0.5, .velocity = 0};
  robot.joints.push_back(joint);

  for (const auto role : {Muscle::Role::flexor, Muscle::Role::extensor}) {
    Muscle muscle;
    muscle.name = name + (role == Muscle::Role::flexor ? "_flexor" : "_extensor");
    muscle.joint = name;
    muscle.role = role;
    muscle.actuator = "bpa";
    muscle.count = 2;
    muscle.mount_length = 3.15 * inch;
    muscle.inlet = "inlet";
    muscle.exhaust = "exhaust";
    muscle.inlet_bit = static_cast<int>(robot.muscles.size());
    muscle.exhaust_bit = muscle.inlet_bit + 8;
    robot.muscles.push_back(muscle);
  }
}

inline void add_sensor(Robot& robot, Sensor::Kind kind, const std::string& of) {
  Sensor sensor;
  sensor.name = of + "_sensor";
  sensor.kind = kind;
  sensor.of = of;
  sensor.scale = sensor.assumed_scale = 1.0;
  sensor.channel = static_cast<int>(robot.sensors.size());
  sensor.tick = 1 + 2 * sensor.channel;
  robot.sensors.push_back(sensor);
}

inline Robot leg() {
  Robot robot;
  robot.name = "leg";
  robot.links = {{"femur", 8.875 * inch, 0.7, 4.4375 * inch, 0.003},
                 {"tibia", 6.25 * inch, 0.2, 3.125 * inch, 0.0005}};
  add_joint(robot, "hip", 278 * degree, Joint::Flexion::raises_angle);
  add_joint(robot, "knee", 314 * degree, Joint::Flexion::lowers_angle);
  for (const Joint& joint : robot.joints) add_sensor(robot, Sensor::Kind::angle, joint.name);
  for (const Muscle& muscle : robot.muscles) add_sensor(robot, Sensor::Kind::tension, muscle.name);

  robot.foot = {.present = true, .mass = 0.05, .radius = 0.02, .friction = 1};
  robot.ground = {
      .present = true, .height = -13 * inch, .normal_stiffness = 5e4, .normal_damping = 50};
  robot.trolley.present = true;
  robot.trolley.total_mass = 10.8;
  return robot;
}

// Returns the leg twice on one body, both hips on one axis: legs left and right.
inline Robot two_legs() {
  const Robot one = leg();
  Robot robot = one;
  robot.links.clear(), robot.joints.clear(), robot.muscles.clear(), robot.sensors.clear();
  for (const std::string name : {"left", "right"}) {
    const auto named = [&](const std::string& part) { return name + "_" + part; };
    Leg& leg = robot.legs.emplace_back();
    leg.name = name;
    for (Link link : one.links) {
      link.parent = link.name == "femur" ? std::string(body_name) : "";
      link.name = named(link.name);
      robot.links.push_back(link);
    }
    for (Joint joint : one.joints) {
      joint.name = named(joint.name);
      leg.joints.push_back(joint.name);
      robot.joints.push_back(joint);
    }
    for (Muscle muscle : one.muscles) {
      muscle.name = named(muscle.name);
      muscle.joint = named(muscle.joint);
      muscle.inlet_bit = static_cast<int>(robot.muscles.size());
      muscle.exhaust_bit = muscle.inlet_bit + 8;
      robot.muscles.push_back(muscle);
    }
    for (const Sensor& sensor : one.sensors) add_sensor(robot, sensor.kind, named(sensor.of));
  }
  robot.trolley.total_mass += leg_mass(one);
  return robot;
}

}  // namespace sinew::robot::test
