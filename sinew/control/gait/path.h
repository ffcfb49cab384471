// control/gait/path.h - where a phase wants the foot, and profiles over a phase, at progress s.
//
// No heap; s beyond 0 .. 1 stands for the nearer end.
#pragma once

#include "sinew/control/gait/plan.h"
#include "sinew/robot/kinematics.h"

namespace sinew::gait {

// The profile at s; `otherwise` where it is empty.
double value_at(const Profile&, double s, double otherwise) noexcept;

// c0 + c1 u + c2 u^2 + ...
double polynomial_at(const Profile& coefficients, double u) noexcept;

// How far the measured normal force lifts a path (> 0) or lowers it  [m]; 0 without a reading.
double correction(const GroundForce&, double normal_force) noexcept;

// [65]-[70] for the thesis's walk  [m]. The phase must have a path.
robot::Point foot_at(const Phase&, double s) noexcept;

}  // namespace sinew::gait
