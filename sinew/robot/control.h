// robot/control.h - parameters of a joint's own controller other than its gains.
#pragma once

#include <vector>

namespace sinew::robot {

// Estimator of a joint's velocity, 6.5 and 7.3; the laws are in control/joint/velocity.h.
struct Velocity {
  // Names the estimator: from two angles; from several; a model with bounded acceleration; a model
  // with known noise; or a velocity sensor.
  enum class Estimator { difference, weighted_average, bounded_observer, kalman, sensor };

  Estimator estimator = Estimator::difference;

  // Weighted average
  int samples = 5;              // number of angles
  std::vector<double> weights;  // newest first, sum 0; empty: a least-squares line [1/s]

  // Bounded observer, Kalman: model of the joint
  double inertia = 0;       // inertia of all parts that turn with it [kg m^2]
  double damping = 0;       // [N m s/rad]
  bool tensions = false;    // the torque of the measured tensions is part of the model
  double acceleration = 0;  // not modelled: the largest, or the standard deviation [rad/s^2]
  double speed_limit = 0;   // bounded observer; 0: no limit [rad/s]
  double noise = 0;         // Kalman: noise of the angle in addition to its rounding [count]
};

// Source of the stiffness law's K_act, 7.2.
enum class StiffnessSource { forces, flexor_force, extensor_force, pressures, none };

// Parameters of a joint whose valves set pressures: 3-way valves by duty, or regulators.
struct PressureLaw {
  double bias = 0.5;              // duty, or share of the range, at zero error [-]
  double angle_integral = 0;      // regulators only [1/(count s)]
  double stiffness_integral = 0;  // regulators only [1/(N m s/rad)]
};

}  // namespace sinew::robot
