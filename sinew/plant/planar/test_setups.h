// plant/planar/test_setups.h - small machines for the tests of this folder, stated in SI in one place.
#pragma once

#include "sinew/plant/planar/setup.h"

namespace sinew::plant {

// The leg's two links under its trolley, and nothing that pulls or rubs.
inline Setup leg_without_muscles(double hip, double knee) {
  constexpr double inch = 0.0254, pound = 0.45359237;
  Setup s;
  s.robot.name = "leg";
  s.robot.links = {{"femur", 8.875 * inch, 1.579 * pound, 4.4375 * inch, 10.36 * pound * inch * inch},
                   {"tibia", 6.25 * inch, 0.469 * pound, 3.125 * inch, 1.527 * pound * inch * inch}};
  robot::Joint joint;
  joint.moment_arm = inch;
  joint.name = "hip";
  s.robot.joints.push_back(joint);
  joint.name = "knee";
  joint.flexion = robot::Joint::Flexion::lowers_angle;
  s.robot.joints.push_back(joint);
  s.robot.trolley = {.present = true, .total_mass = 23.8 * pound, .drag = 0, .track_length = 100};
  s.robot.foot = {.present = true, .mass = 0.1 * pound, .radius = 0.02, .friction = 0};
  s.start.joint_angle = {hip, knee};
  s.start.blocked = {false, false};
  s.start.pressure = s.air.atmosphere;
  return s;
}

}  // namespace sinew::plant
