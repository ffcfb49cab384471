// run/setup/stance_text.h - a stance for people and for programs.
#pragma once

#include <string>

#include "sinew/run/setup/stance.h"

namespace sinew::run {

// The units in which people read it.
struct StanceUnits {
  std::string length = "m", angle = "deg", torque = "N m", jacobian = "m/rad";
};

// Returns lines of text: foot, joints, muscles, Jacobian, torques.
std::string text_of(const robot::Robot& robot, const Stance& stance, const StanceUnits& units);

// Returns an object of JSON, in SI.
std::string json_of(const robot::Robot& robot, const Stance& stance);

}  // namespace sinew::run
