// mechanism/planar/test_setups.h - small machines for the tests of this folder, in SI units.
#pragma once

#include <random>
#include <string>

#include "sinew/actuator/thesis_actuator.h"
#include "sinew/mechanism/planar/setup.h"
#include "sinew/units/constants.h"

namespace sinew::plant {

inline constexpr double pound = units::pound_mass;
using units::inch;

// Returns the leg's two links under its trolley, in the air, without muscles and friction.
inline Setup leg_without_muscles(double hip, double knee) {
  Setup s;
  s.robot.name = "leg";
  s.robot.links = {
      {"femur", 8.875 * inch, 1.579 * pound, 4.4375 * inch, 10.36 * pound * inch * inch},
      {"tibia", 6.25 * inch, 0.469 * pound, 3.125 * inch, 1.527 * pound * inch * inch}};
  robot::Joint joint;
  joint.moment_arm = inch;
  joint.name = "hip";
  joint.rest_angle = 4.85;
  s.robot.joints.push_back(joint);
  joint.name = "knee";
  joint.rest_angle = 5.48;
  joint.flexion = robot::Joint::Flexion::lowers_angle;
  s.robot.joints.push_back(joint);
  s.robot.trolley = {.present = true,
                     .total_mass = 23.8 * pound,
                     .drag = 0,
                     .track_length = 100,
                     .stop_stiffness = 2e4,
                     .stop_damping = 300};
  s.robot.foot = {.present = true, .mass = 0.1 * pound, .radius = 0.02, .friction = 0.8};
  s.robot.ground = {
      .present = false, .height = -13 * inch, .normal_stiffness = 5e4, .normal_damping = 90};
  s.start.joint_angle = {hip, knee};
  s.start.blocked = {false, false};
  s.start.pressure = s.air.atmosphere;
  return s;
}

// Returns links without muscles, each attached anywhere along an earlier one or to the body.
inline Setup random_tree(std::mt19937& random, std::size_t links = 4) {
  std::uniform_real_distribution<double> share(0, 1), angle(-3, 3);
  Setup s = leg_without_muscles(0, 0);
  const robot::Link femur = s.robot.links[0];
  s.robot.links.clear(), s.robot.joints.clear();
  s.start.joint_angle.clear(), s.start.blocked.clear();
  for (std::size_t i = 0; i < links; ++i) {
    robot::Link link = femur;
    link.name = "link" + std::to_string(i);
    link.length *= 0.5 + share(random);
    link.mass *= 0.5 + share(random);
    const std::size_t on = random() % (i + 1);
    link.parent = on == i ? std::string(robot::body_name) : s.robot.links[on].name;
    link.at = on == i ? share(random) - 0.5 : s.robot.links[on].length * share(random);
    s.robot.links.push_back(link);
    robot::Joint joint;
    joint.name = "joint" + std::to_string(i);
    joint.kind = robot::Joint::Kind::passive;
    s.robot.joints.push_back(joint);
    s.start.joint_angle.push_back(angle(random));
    s.start.blocked.push_back(false);
  }
  return s;
}

inline gas::Valve test_valve(double area) {
  gas::Valve v{.name = "valve"};
  v.flow.area = area;
  v.opening_delay = 0.37e-3;
  v.closing_delay = 0.61e-3;
  return v;
}

// Returns the same leg with its four doubled muscles, and sensors for their tensions and angles.
inline Setup leg_with_muscles(double hip, double knee) {
  Setup s = leg_without_muscles(hip, knee);
  for (const char* joint : {"hip", "knee"})
    for (const auto role : {robot::Muscle::Role::flexor, robot::Muscle::Role::extensor}) {
      robot::Muscle m;
      m.joint = joint;
      m.role = role;
      m.name = m.joint + (role == robot::Muscle::Role::flexor ? "_flexor" : "_extensor");
      m.count = 2;
      m.mount_length = 3.15 * inch;
      s.robot.muscles.push_back(m);
      air::Muscle out{.name = m.name, .actuator = actuator::thesis_actuator(), .count = 2};
      out.external_volume = 4e-6;
      out.inlet = test_valve(5e-7);
      out.exhaust = test_valve(2e-6);
      s.muscles.push_back(out);
    }
  s.air.polytropic_exponent = 1.2;
  return s;
}

}  // namespace sinew::plant
