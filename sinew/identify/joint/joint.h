// identify/joint/joint.h - force law and moment arm of a joint's muscles from its angle, the
// pressures and a known load at rest, without measuring a length or a force.
//
//   tau_load + sign N (r(q) F(L_flex, P_flex) - r(-q) F(L_ext, P_ext)) = 0
//   q = sign (theta - theta_rest)     L_flex = L_m,flex - DL(q),   L_ext = L_m,ext - DL(-q)
//   F = P_g b^2/(4 pi n^2) (3 L^2/b^2 - 1)(c0 + c1 P_g) + bladder, not below 0
//   tau_load = - g (m l + m_limb l_limb) sin(theta - theta_down), or as measured
//
//   theta  joint's angle [rad]         tau_load  torque of the load, raises the angle > 0 [N m]
//   r, DL  hinge.h                     L_m       lengths at the rest angle [m]
// A joint that moves, and unknown sensors: tau = bias + gain tau_m(t - delay), where tau_m is the
// torque of the above with tau_c sign(d theta/dt) + c_j d theta/dt.
//
//   sign   +1 if flexion raises the angle, else -1      N  actuators side by side
//   m, l   load [kg] and its lever [m], straight down at theta_down
//
// One muscle, or a flexor and an extensor alike but for their lengths. What torques cannot tell:
// with small excursions only r F counts, so a longer arm and a weaker muscle are the same; that is
// found out from the covariance and said. Without any known load nothing has a scale: refused. Dry
// friction of the joint is in the residuals; approach every pose from both sides.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/actuator/actuator.h"
#include "sinew/host/side_by_side.h"
#include "sinew/identify/data/measured.h"
#include "sinew/identify/fit/fit.h"
#include "sinew/identify/fit/wish.h"

namespace sinew::identify {

inline constexpr double to_be_found = std::numeric_limits<double>::quiet_NaN();

// Holds what is known of the joint, its muscles and its load.
struct JointSetup {
  actuator::Actuator actuator;  // braid and bladder are taken as they are
  int count = 1;                // N
  double atmosphere = 0;        // [Pa]
  double gravity = 0;           // [m/s^2]
  bool flexion_raises = true;
  double rest_angle = 0;            // theta_rest [rad]
  double load = to_be_found;        // m, where no column has it [kg]
  double lever = 0, down = 0;       // l [m], theta_down [rad]
  double limb = 0, limb_lever = 0;  // [kg], [m]

  // Of the torque's sensor, where it is asked for: each recording's zero; a gain of each recording
  // but the first, or of each with `keep_force`. A joint that moves, over `time`: its dry friction
  // and damping, and how far the torque comes behind angle and pressures.
  bool torque_bias = false, torque_gain = false, moving = false;
  std::vector<std::string> recordings;  // their names, by the number in a column `recording`

  // What is known is not fitted.
  double moment_arm = to_be_found;                                    // at the rest angle [m]
  double flexor_length = to_be_found, extensor_length = to_be_found;  // [m]
  bool keep_force = false;  // c0, c1 as in the actuator's effectiveness
};

// angle, flexor_pressure, extensor_pressure (one of them at least), torque or load if there is one.
// With `moving` also time; of poses at rest it may run as it likes.
std::span<const Wanted> joint_columns(bool moving);

// A product of powers of parameters and how well the data determine it.
struct Combination {
  std::string text;           // "moment_arm^0.71 c0^0.70"
  double relative_error = 0;  // half a 95 % interval; infinite: not at all [1]
};

struct JointResult {
  // NaN where there is no such muscle.
  double moment_arm = 0, flexor_length = 0, extensor_length = 0;
  std::vector<double> cam_angle, cam_flexor, cam_extensor;  // arms of a hinge; empty: round
  actuator::Effectiveness effectiveness;
  std::vector<Combination> combinations;  // of the chosen model, best determined first
  Report report;
};

// Held out: `held_out`, or else every third row. `model`: only that one; empty: all. `wishes` are
// for moment_arm, origin_ratio, origin_angle, flexor_length, extensor_length, c0 and c1. `done`
// counts the models that have been tried. Throws Refusal, config::Error for a wish of a parameter
// that there is not, and std::invalid_argument for an unknown model.
JointResult identify_joint(const Measured& data, const std::optional<Measured>& held_out,
                           const JointSetup& setup, std::string_view model = "",
                           const Wishes& wishes = {}, host::Tally* done = nullptr);
std::vector<std::string> joint_models();

}  // namespace sinew::identify
