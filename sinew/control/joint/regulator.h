// control/joint/regulator.h - laws of a joint whose muscles have pressure regulators.
//
// A regulator sets a pressure, not a flow, so the air does not integrate as in laws.h, and the law
// has to:
//
//   mean       = bias + U_k + I_k             I_k     += G_ik (K_des - K_act)
//   difference = U_theta + I_theta            I_theta += G_itheta s (theta_des - theta_act)
//
//   flexor  = mean + difference,  extensor = mean - difference
//
// All values are in percent of the regulator's range; the integrals are updated once per law; s is
// JointConfig::flexion. An integral is limited to what the setpoints can use, and is not changed
// while both setpoints are at a limit and the error would drive them further (anti-windup).
// Setpoints are whole 12-bit levels, once per period. All functions are pure.
#pragma once

#include <cstdint>

#include "sinew/control/joint/exact.h"
#include "sinew/signals/port.h"

namespace sinew::control {

struct RegulatorConfig {
  float angle_integral = 0;      // G_itheta, per law [%/count]
  float stiffness_integral = 0;  // G_ik, per law [%/(lbf in/rad)]
};

struct RegulatorState {
  float mean = 0, difference = 0;  // I_k, I_theta [%]
};

// Setpoints of both muscles; signals::max_level is the end of the regulator's range.
struct Levels {
  std::uint16_t flexor = 0, extensor = 0;

  friend constexpr bool operator==(const Levels&, const Levels&) = default;
};

// Returns the nearest level of a share in percent.
constexpr std::uint16_t level_of(float percent) noexcept {
  const float inside = clamped(percent, 100.0f);
  const float level = inside * (static_cast<float>(signals::max_level) / 100.0f) + 0.5f;
  return static_cast<std::uint16_t>(inside > 0 ? level : 0.0f);
}

struct RegulatorInput {
  float bias = 50;           // [%]
  float u_k = 0;             // [58] [%]
  float u_theta = 0;         // [59], positive flexes [%]
  float stiffness_step = 0;  // change of I_k by this law [%]
  float angle_step = 0;      // change of I_theta by this law [%]
};

// Clamps x to the two bounds.
constexpr float held_between(float x, float low, float high) noexcept {
  return x < low ? low : x > high ? high : x;
}

// Returns the setpoints of flexor and extensor, and updates the integrals for a period.
constexpr Levels regulate(RegulatorState& state, const RegulatorInput& in) noexcept {
  const auto mean = [&] { return in.bias + in.u_k + state.mean; };
  const auto turn = [&] { return in.u_theta + state.difference; };

  const float high = mean() + turn(), low = mean() - turn();  // flexor, extensor
  const bool full = high >= 100.0f && low >= 100.0f, empty = high <= 0.0f && low <= 0.0f;
  if (!(full && in.stiffness_step > 0) && !(empty && in.stiffness_step < 0))
    state.mean = held_between(state.mean + in.stiffness_step, -in.bias, 100.0f - in.bias);

  const bool flexed = high >= 100.0f && low <= 0.0f, extended = high <= 0.0f && low >= 100.0f;
  if (!(flexed && in.angle_step > 0) && !(extended && in.angle_step < 0))
    state.difference = held_between(state.difference + in.angle_step, -100.0f, 100.0f);

  return {level_of(mean() + turn()), level_of(mean() - turn())};
}

}  // namespace sinew::control
