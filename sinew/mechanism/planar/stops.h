// mechanism/planar/stops.h - what holds a joint within its range: a spring and a damper at either
// end.
//
//   tau = -(k_stop (theta - high) + c_stop theta')   beyond the highest angle, never pulling it on
//   tau =   k_stop (low - theta)  - c_stop theta'    below the lowest one, the same way round
#pragma once

#include <limits>

#include "sinew/robot/robot.h"
#include "sinew/units/pack.h"

namespace sinew::plant {

// A joint's stop, of a double or of a pack; without bounds there is none.
template <class S>
struct JointStopOf {
  S low = -std::numeric_limits<double>::infinity();
  S high = std::numeric_limits<double>::infinity();  // [rad]
  S stiffness = 0, damping = 0;                      // [N m/rad], [N m s/rad]

  JointStopOf() = default;
  // Takes the stop of a robot's joint.
  explicit JointStopOf(const robot::Stop& stop) {
    if (!stop.present()) return;
    low = stop.range[0];
    high = stop.range[1];
    stiffness = stop.stiffness;
    damping = stop.damping;
  }

  // > 0 raises the angle  [N m].
  S torque(const S& angle, const S& rate) const noexcept {
    const auto above = angle > high, below = angle < low;
    if (!units::any(above | below)) return 0;
    const S down = stiffness * (angle - high) + damping * rate;
    const S up = stiffness * (low - angle) - damping * rate;
    return units::select(above, units::select(down > 0.0, -down, 0.0),
                         units::select(below & (up > 0.0), up, 0.0));
  }
};
using JointStop = JointStopOf<double>;

}  // namespace sinew::plant
