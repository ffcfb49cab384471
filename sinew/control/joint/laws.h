// control/joint/laws.h - the two laws of a joint and how they become valve duties [54]-[60].
//
//   K_act   = K_flexor + K_extensor,  K = 6 F / (3 L - b^2/L)          [27], [60]
//   U_k     = G_k (K_des - K_act)                                      [58]
//   U_theta = G_theta (theta_des - theta_act) - G_v d theta_act/dt     [59], last term: appendix B
//
//   extensor inlet  =  U_k - U_theta   [54]      flexor inlet  =  U_k + U_theta   [56]
//   extensor exhaust = -U_k + U_theta  [55]      flexor exhaust = -U_k - U_theta  [57]
//
// with negative duties shut. Angles and lengths in counts, forces in counts, stiffness in lbf
// in/rad, U in percent of a period. Positive U_theta flexes; JointConfig::flexion says what that
// does to the angle. Pure functions.
//
// Departures from appendix B, all outside what the leg's runs reach:
//   - near its pole [27] gives no value, where the code casts whatever it finds to `short`
//   - outputs and sums saturate, where the code's `short` wraps
//   - the speed is the step times 100/s, where the code divides by the double 0.01, which is larger
//     by 2e-17: an output that is a whole number but for that comes out one lower in the code
#pragma once

#include <cstdint>

#include "sinew/control/joint/command.h"
#include "sinew/control/joint/config.h"
#include "sinew/control/joint/exact.h"

namespace sinew::control {

struct Lengths {
  std::int32_t flexor, extensor;  // [count]
};

// A muscle shortens by as many counts as the joint turns towards it. `lengths_swapped` is the
// code's way at the knee, where it forgets that flexion lowers the angle.
constexpr Lengths muscle_lengths(const JointConfig& joint, std::int32_t angle) noexcept {
  const std::int32_t towards = joint.lengths_swapped ? -joint.flexion : joint.flexion;
  const std::int32_t flexed = towards * (angle - joint.angle_at_rest);
  return {joint.flexor.free_length - flexed, joint.extensor.free_length + flexed};
}

// Shorter than the pole of [27], L = b/sqrt(3), plus `clamp`.
constexpr bool near_pole(const JointConfig& joint, std::int32_t length) noexcept {
  const std::int64_t above = length - joint.pole_clamp;
  return above <= 0 || 3 * above * above <= joint.thread_length_squared;
}

// 3 L - b^2/L of [27], [count]; 0 where there is none. The code divides whole numbers.
constexpr float pole_term(std::int32_t length, std::int32_t b_squared, Truncation mode) noexcept {
  if (length == 0) return 0;
  if (mode == Truncation::each_law) return static_cast<float>(3 * length - b_squared / length);
  const float l = static_cast<float>(length);
  return 3.0f * l - static_cast<float>(b_squared) / l;
}

struct Stiffness {
  float value = 0;     // [lbf in/rad]
  bool valid = false;  // false: a muscle is too near the pole, keep the last one
};

// [60] with [27], tensions in counts. One pair of actuators or several in parallel: the tension is
// the bundle's, so is the stiffness (thesis 5.1).
constexpr Stiffness joint_stiffness(const JointConfig& joint, Truncation mode, std::int32_t angle,
                                    std::int32_t flexor_tension,
                                    std::int32_t extensor_tension) noexcept {
  const Lengths length = muscle_lengths(joint, angle);
  if (near_pole(joint, length.flexor) || near_pole(joint, length.extensor)) return {};
  const float flexor = pole_term(length.flexor, joint.thread_length_squared, mode);
  const float extensor = pole_term(length.extensor, joint.thread_length_squared, mode);
  if (flexor == 0 || extensor == 0) return {};
  const float six = 6.0f * joint.stiffness_factor * joint.moment_arm_factor;
  return {six * (static_cast<float>(flexor_tension) / flexor +
                 static_cast<float>(extensor_tension) / extensor),
          true};
}

inline constexpr float gain_limit = 1000.0f;
inline constexpr float stiffness_limit = 1e6f;      // [lbf in/rad]
inline constexpr std::int32_t angle_limit = 32767;  // [count]

// [58]
constexpr Exact stiffness_law(float gain, float desired, float actual) noexcept {
  return clamped(gain, gain_limit) *
         two_sum(clamped(desired, stiffness_limit), -clamped(actual, stiffness_limit));
}

// [59], with the velocity term of appendix B. `rate`: laws per second.
constexpr Exact angle_law(const Gains& gains, std::int8_t flexion, std::int32_t desired,
                          std::int32_t actual, std::int32_t previous, float rate) noexcept {
  const std::int32_t error = flexion * (clamped(desired, -angle_limit, angle_limit) - actual);
  const std::int32_t step = flexion * (actual - previous);
  return two_product(clamped(gains.angle, gain_limit), static_cast<float>(error)) -
         two_product(clamped(gains.velocity, gain_limit), static_cast<float>(step) * rate);
}

// 0 .. 100, what is negative makes no sense as a duty (thesis 5.1).
constexpr std::int32_t clipped(std::int32_t duty) noexcept {
  return clamped(duty, 0, signals::max_duty);
}

// [54]-[57]: each muscle's signed duty to its two valves, of which one at least stays shut.
constexpr Duties to_duties(std::int32_t flexor, std::int32_t extensor) noexcept {
  return {clipped(flexor), clipped(-flexor), clipped(extensor), clipped(-extensor)};
}

// The same from the laws' real outputs: where they become whole percents is the mode's choice.
constexpr Duties to_duties(Exact stiffness, Exact angle, Truncation mode) noexcept {
  switch (mode) {
    case Truncation::sum:
      return to_duties(truncated(stiffness + angle), truncated(stiffness - angle));
    case Truncation::none:
      return to_duties(rounded(stiffness + angle), rounded(stiffness - angle));
    case Truncation::each_law:
      break;
  }
  const std::int32_t u_k = truncated(stiffness), u_theta = truncated(angle);
  return to_duties(u_k + u_theta, u_k - u_theta);
}

// Appendix B's joint 0: position of a double-acting cylinder. With feedforward on inlet and exhaust
// of one chamber both are open together, by design: a standing flow that stiffens the piston.
constexpr Duties cylinder_duties(const Duties& forward, Exact position, Truncation mode) noexcept {
  const std::int32_t u = mode == Truncation::none ? rounded(position) : truncated(position);
  return {clipped(forward.flexor_inlet + u), clipped(forward.flexor_exhaust - u),
          clipped(forward.extensor_inlet - u), clipped(forward.extensor_exhaust + u)};
}

// Duties from outside in place of a law's. An exhaust shuts out its muscle's inlet (ours: the code
// takes any four).
constexpr Duties open_loop_duties(const Duties& wanted, JointKind kind) noexcept {
  Duties d{clipped(wanted.flexor_inlet), clipped(wanted.flexor_exhaust),
           clipped(wanted.extensor_inlet), clipped(wanted.extensor_exhaust)};
  if (kind == JointKind::cylinder) return d;
  if (d.flexor_exhaust > 0) d.flexor_inlet = 0;
  if (d.extensor_exhaust > 0) d.extensor_inlet = 0;
  return d;
}

}  // namespace sinew::control
