// control/gait/path.h - foot position and profiles of a phase at progress s.
//
// No heap; s is clamped to 0 .. 1.
#pragma once

#include "sinew/control/gait/plan.h"
#include "sinew/robot/kinematics.h"

namespace sinew::gait {

// Returns the profile at s; `otherwise` if it is empty.
double value_at(const Profile&, double s, double otherwise) noexcept;

// Returns c0 + c1 u + c2 u^2 + ...
double polynomial_at(const Profile& coefficients, double u) noexcept;

// Returns the change of height of a path by the measured normal force, positive upwards [m]; 0
// without a reading.
double correction(const GroundForce&, double normal_force) noexcept;

// Returns the foot's position, [65]-[70] for the thesis's walk [m]. The phase must have a path.
robot::Point foot_at(const Phase&, double s) noexcept;

}  // namespace sinew::gait
