// control/setup/estimators.h - constants of a joint's velocity estimator from the robot's
// description. They are computed once, before the run, in double; the low level uses floats.
//
//   I theta'' = tau - c theta' + I alpha_w     over a period t_p, tau and alpha_w constant:
//
//   theta' = theta + g v + h (tau/I + alpha_w)    k = c/I,  a = exp(-k t_p)
//   v'     = a v + g (tau/I + alpha_w)            g = (1 - a)/k,  h = (t_p - g)/k
//                                                 k = 0: g = t_p, h = t_p^2/2
//
//   tau      r F c_F, of the measured tensions [N m]     I  inertia [kg m^2]
//   alpha_w  acceleration by causes outside the model    c  damping [N m s/rad]
//            [rad/s^2]
//
// Kalman's shares are those of the steady state. The Riccati equation for the covariance P,
//
//   P- = A P A^T + Q,  K = P- H^T/(H P- H^T + R),  P = (I - K H) P-
//
// is iterated until it is steady, with Q from alpha_w's deviation and R = noise^2 + 1/12 for
// rounding to whole counts.
#pragma once

#include <array>

#include "sinew/control/joint/velocity.h"
#include "sinew/robot/robot.h"

namespace sinew::control {

// Motion of a joint over one period: a, g, h above.
struct JointMotion {
  double decay = 1;        // [-]
  double travel = 0;       // g [s]
  double travel_gain = 0;  // h [s^2]
};
JointMotion joint_motion(double inertia, double damping, double period);

struct SteadyState {
  double angle_share = 0;              // K_1 [-]
  double speed_share = 0;              // K_2 [1/s]
  std::array<double, 3> covariance{};  // after a reading: of angle, both, speed [count^2], /s, /s^2
};

// `acceleration`: standard deviation of alpha_w [count/s^2]; `noise`: of a reading, including
// rounding [count].
SteadyState steady_state(const JointMotion& motion, double acceleration, double noise);

// `torque_per_count`: torque per count of the flexor's tension [N m]; `rate`: laws per second.
VelocityConfig velocity_config(const robot::Robot& robot, int joint, double torque_per_count,
                               double rate);

}  // namespace sinew::control
