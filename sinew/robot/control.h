// robot/control.h - what a joint's own controller is told about it, beside its gains.
#pragma once

#include <vector>

namespace sinew::robot {

// How the speed of a joint is found, 6.5 and 7.3; the laws stand in control/joint/velocity.h.
struct Velocity {
  // Names how the speed is found: by two angles, several, a model that trusts its acceleration, one
  // of known noise, or a sensor of its own.
  enum class Estimator { difference, weighted_average, bounded_observer, kalman, sensor };

  Estimator estimator = Estimator::difference;

  // Weighted average
  int samples = 5;              // angles looked at
  std::vector<double> weights;  // newest first, their sum 0; empty: a least-squares line [1/s]

  // Bounded observer, Kalman: the joint as they take it
  double inertia = 0;       // of everything that turns with it [kg m^2]
  double damping = 0;       // [N m s/rad]
  bool tensions = false;    // the torque of the measured tensions is part of the model
  double acceleration = 0;  // not in the model: the largest, or the standard deviation [rad/s^2]
  double speed_limit = 0;   // bounded observer; 0: none [rad/s]
  double noise = 0;         // Kalman: of the angle, beside its rounding [count]
};

// Where the stiffness law's K_act comes from, 7.2.
enum class StiffnessSource { forces, flexor_force, extensor_force, pressures, none };

// Of a joint whose valves set pressures: 3-way valves by duty, or regulators.
struct PressureLaw {
  double bias = 0.5;              // duty, or share of the range, without errors [-]
  double angle_integral = 0;      // regulators only [1/(count s)]
  double stiffness_integral = 0;  // regulators only [1/(N m s/rad)]
};

}  // namespace sinew::robot
