// run/setup/stance.h - pose of a machine at given joint angles: position of its foot, and
// lengths of its muscles with the limits of their range.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "sinew/experiment/experiment.h"
#include "sinew/robot/kinematics.h"

namespace sinew::run {

// A muscle at some joint angles.
struct MuscleAt {
  std::string name;
  double length = 0, shortest = 0, longest = 0;  // [m]

  // Returns whether the muscle can have this length.
  bool within() const { return length >= shortest && length <= longest; }
};

struct Stance {
  std::vector<double> angles;  // joint angles [rad]
  robot::Point foot;           // relative to the first joint [m]
  std::vector<MuscleAt> muscles;
  std::optional<robot::Jacobian> jacobian;  // derivative of the foot by the angles; two links only
                                            // [m/rad]
  std::vector<double> torques;              // joint torques [N m]; empty unless a force was given

  // Returns whether every muscle can have its length.
  bool within() const {
    return std::ranges::all_of(muscles, [](const MuscleAt& m) { return m.within(); });
  }
};

// Returns the machine at these angles, one per joint in the robot's order [rad]. Lengths of muscles
// are calculated at the equivalent angle nearest to the joint's rest angle.
Stance stance(const experiment::Experiment& experiment, const std::vector<double>& angles);

// A stance as text and as JSON.

// The units of the text.
struct StanceUnits {
  std::string length = "m", angle = "deg", torque = "N m", jacobian = "m/rad";
};

// Returns the units of the robot's file, by its first link and joint, and those of torques by the
// force, "0 lbf, -20 lbf"; may be empty.
StanceUnits units_of_file(const experiment::Experiment& experiment, const std::string& force);

// Stance of a machine: by its foot or its angles, as text.
struct StanceRequest {
  std::string foot, angles;  // "-2 in, -13 in" about the first joint; or one angle per joint
  std::string force;         // of the foot: the torques for it, [71]; may be empty
};

// Returns all ways in which a robot of one leg stands so. Throws config::Error where a text is no
// quantity or the foot cannot be there, and std::invalid_argument for a robot without joints.
std::vector<Stance> stances(const experiment::Experiment& experiment, const StanceRequest& request,
                            const StanceUnits& units = {});

// Returns lines of text: foot, joints, muscles, Jacobian, torques.
std::string text_of(const robot::Robot& robot, const Stance& stance, const StanceUnits& units);

// Returns a JSON object, in SI.
std::string json_of(const robot::Robot& robot, const Stance& stance);

}  // namespace sinew::run
