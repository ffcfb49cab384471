// plant/planar/stops.h - what holds a joint within its range: a spring and a damper at either end.
//
//   tau = -(k (theta - high) + c theta')   beyond the highest angle, never pulling it on
//   tau =   k (low - theta)  - c theta'    below the lowest one, the same way round
#pragma once

#include <limits>

#include "sinew/robot/robot.h"

namespace sinew::plant {

struct JointStop {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();  // [rad]
  double stiffness = 0, damping = 0;                      // [N m/rad], [N m s/rad]

  JointStop() = default;
  explicit JointStop(const robot::Stop& stop) {
    if (!stop.present()) return;
    low = stop.range[0];
    high = stop.range[1];
    stiffness = stop.stiffness;
    damping = stop.damping;
  }

  // > 0 raises the angle  [N m].
  double torque(double angle, double rate) const noexcept {
    if (angle > high) {
      const double push = stiffness * (angle - high) + damping * rate;
      return push > 0 ? -push : 0.0;
    }
    if (angle < low) {
      const double push = stiffness * (low - angle) - damping * rate;
      return push > 0 ? push : 0.0;
    }
    return 0;
  }
};

}  // namespace sinew::plant
