// identify/joint/joint.h - force law and moment arm of a joint's muscles, from its angle, the
// pressures and a known load at rest, without measuring a length or a force.
//
//   tau_load + sign N (r(q) F(L_flex, P_flex) - r(-q) F(L_ext, P_ext)) = 0
//   q = sign (theta - theta_rest)     L_flex = L_m,flex - DL(q),   L_ext = L_m,ext - DL(-q)
//   F = P_g b^2/(4 pi n^2) (3 L^2/b^2 - 1)(c0 + c1 P_g) + bladder, not below 0
//   tau_load = - g (m l + m_limb l_limb) sin(theta - theta_down), or as measured
//
//   theta  joint's angle [rad]         tau_load  torque of the load, raises the angle > 0 [N m]
//   r, DL  torque.h                    L_m       lengths at the rest angle [m]
// For a moving joint and uncalibrated sensors: tau = bias + gain tau_m(t - delay), where tau_m is
// the torque from the above with tau_c sign(d theta/dt) + c_j d theta/dt.
//
//   sign   +1 if flexion raises the angle, else -1      N  actuators side by side
//   m, l   load [kg] and its lever [m], straight down at theta_down
//
// One muscle, or a flexor and an extensor that differ only in length. Not determined by torques:
// with small excursions only r F counts, so a longer arm and a weaker muscle are equivalent;
// this follows from the covariance and is reported. Without a known load there is no scale,
// and the data are refused. Dry friction of the joint is in the residuals; every pose should be
// approached from both sides.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/actuator/actuator.h"
#include "sinew/host/side_by_side.h"
#include "sinew/identify/contest/constraint.h"
#include "sinew/identify/contest/fit.h"
#include "sinew/identify/data/measured.h"

namespace sinew::identify {

inline constexpr double to_be_found = std::numeric_limits<double>::quiet_NaN();

// Known properties of the joint, its muscles and its load.
struct JointSetup {
  actuator::Actuator actuator;  // braid and bladder are not fitted
  int count = 1;                // N
  double atmosphere = 0;        // [Pa]
  double gravity = 0;           // [m/s^2]
  bool flexion_raises = true;
  double rest_angle = 0;            // theta_rest [rad]
  double load = to_be_found;        // m, if no column has it [kg]
  double lever = 0, down = 0;       // l [m], theta_down [rad]
  double limb = 0, limb_lever = 0;  // [kg], [m]

  // Fitted properties of the torque sensor: a zero for each recording; a gain for each recording
  // except the first, or for all with `keep_force`. `moving`: the joint moves over `time`, and its
  // dry friction, damping, and the delay of the torque behind angle and pressures are fitted.
  bool torque_bias = false, torque_gain = false, moving = false;
  std::vector<std::string> recordings;  // names, by the number in a column `recording`

  // Known values are not fitted.
  double moment_arm = to_be_found;                                    // at the rest angle [m]
  double flexor_length = to_be_found, extensor_length = to_be_found;  // [m]
  bool keep_force = false;  // c0, c1 as in the actuator's effectiveness
};

// Returns the columns: angle, flexor_pressure, extensor_pressure (at least one of them), torque or
// load if present; with `moving` also time, which must ascend only then.
std::span<const ColumnSpec> joint_columns(bool moving);

// A product of powers of parameters, and its uncertainty.
struct Combination {
  std::string text;           // "moment_arm^0.71 c0^0.70"
  double relative_error = 0;  // half a 95 % interval; infinite: not determined [1]
};

struct JointResult {
  // NaN for a muscle that does not exist.
  double moment_arm = 0, flexor_length = 0, extensor_length = 0;
  std::vector<double> cam_angle, cam_flexor, cam_extensor;  // arms of a hinge; empty: round
  actuator::Effectiveness effectiveness;
  std::vector<Combination> combinations;  // for the chosen model, best determined first
  Report report;
};

// Identifies the joint. Rows of `held_out`, or else every third row, are held out. `model`: the
// only model to try; empty: all. `constraints` may concern moment_arm, origin_ratio, origin_angle,
// flexor_length, extensor_length, c0 and c1. `done` counts the models that have been tried. Throws
// Refusal, config::Error for a constraint on an unknown parameter, and std::invalid_argument for an
// unknown model.
JointResult identify_joint(const Measured& data, const std::optional<Measured>& held_out,
                           const JointSetup& setup, std::string_view model = "",
                           const Constraints& constraints = {}, host::Tally* done = nullptr);
std::vector<std::string> joint_models();

}  // namespace sinew::identify
