// robot/actuator_of.h - lookup of a muscle's actuator.
#pragma once

#include <cmath>
#include <vector>

#include "sinew/actuator/actuator.h"
#include "sinew/actuator/bladder.h"
#include "sinew/robot/robot.h"

namespace sinew::robot {

// Returns the actuator that the muscle names, with the muscle's own bladder values if set and if
// its bladder is stretched.
inline actuator::Actuator actuator_of(const Muscle& muscle,
                                      const std::vector<actuator::Actuator>& actuators) {
  actuator::Actuator out;
  for (const actuator::Actuator& a : actuators)
    if (a.name == muscle.actuator) out = a;
  if (std::isfinite(muscle.bladder_stiffness)) out.bladder.stiffness = muscle.bladder_stiffness;
  if (std::isfinite(muscle.bladder_rest_length))
    out.bladder.rest_length = muscle.bladder_rest_length;
  actuator::loosen(out);
  return out;
}

}  // namespace sinew::robot
