// control/joint/laws.h - the two laws of a joint and their conversion to valve duties [54]-[60].
//
//   K_act   = K_flexor + K_extensor,  K = 6 F / (3 L - b^2/L)          [27], [60]
//   U_k     = G_k (K_des - K_act)                                      [58]
//   U_theta = G_theta (theta_des - theta_act) - G_v d theta_act/dt     [59], last term: appendix B
//
//   extensor inlet  =  U_k - U_theta   [54]      flexor inlet  =  U_k + U_theta   [56]
//   extensor exhaust = -U_k + U_theta  [55]      flexor exhaust = -U_k - U_theta  [57]
//
// Negative duties mean shut. Angles, lengths and forces are in counts, stiffness in lbf in/rad, U
// in percent of a period. Positive U_theta flexes; JointConfig::flexion relates this to the angle.
// All functions are pure.
//
// Differences from appendix B, all outside the range of the leg's runs:
//   - near its pole [27] gives no value, where the code converts any result to `short`
//   - outputs and sums saturate, where the code's `short` wraps
//   - the speed is by default the step times 100/s, where the code divides by the double 0.01.
//     That is too large by 2e-17: what would be a whole number becomes one lower in the code
#pragma once

#include <cstdint>

#include "sinew/control/joint/command.h"
#include "sinew/control/joint/config.h"
#include "sinew/control/joint/exact.h"

namespace sinew::control {

// Values of a joint's two muscles.
struct Pair {
  std::int32_t flexor = 0, extensor = 0;  // lengths, readings [count], or signed duties [%]
};

// Returns the muscles' lengths. A muscle shortens by as many counts as the joint turns towards it.
// `lengths_swapped` repeats the thesis's code at the knee, which ignores that flexion lowers the
// angle.
constexpr Pair muscle_lengths(const JointConfig& joint, std::int32_t angle) noexcept {
  const std::int32_t towards = joint.lengths_swapped ? -joint.flexion : joint.flexion;
  const std::int32_t flexed = towards * (angle - joint.angle_at_rest);
  return {joint.flexor.free_length - flexed, joint.extensor.free_length + flexed};
}

// Returns whether a muscle is shorter than the pole of [27], L = b/sqrt(3), plus `clamp`.
constexpr bool near_pole(const MuscleConfig& muscle, std::int32_t clamp,
                         std::int32_t length) noexcept {
  const std::int64_t above = std::int64_t{length} - clamp;
  return above <= 0 || 3 * above * above <= muscle.thread_length_squared;
}

// Returns 3 L - b^2/L of [27] [count], or 0 if L is 0. The thesis's code divides integers.
constexpr float pole_term(std::int32_t length, std::int32_t b_squared, Truncation mode) noexcept {
  if (length == 0) return 0;
  if (mode == Truncation::each_law) return static_cast<float>(3 * length - b_squared / length);
  const float l = static_cast<float>(length);
  return 3.0f * l - static_cast<float>(b_squared) / l;
}

struct Stiffness {
  float value = 0;     // [lbf in/rad]
  bool valid = false;  // false: a muscle is too near the pole, keep the last value
};

// Returns a muscle's F/(3 L - b^2/L), in counts of the flexor's transducer; 0 for an absent muscle.
constexpr Stiffness tension_share(const MuscleConfig& muscle, const JointConfig& joint,
                                  Truncation mode, std::int32_t length, float tension) noexcept {
  if (!muscle.present) return {0, true};
  if (near_pole(muscle, joint.pole_clamp, length)) return {};
  const float pole = pole_term(length, muscle.thread_length_squared, mode);
  if (pole == 0) return {};
  return {tension / pole, true};
}

// Returns the stiffness of a joint by [60] and [27], from tensions in counts. For several actuators
// in parallel the tension is the bundle's, and so is the stiffness (thesis 5.1). With one
// transducer, equal tension is assumed for the other muscle: this is right for an unloaded joint at
// rest; a load causes an error of the stiffness.
constexpr Stiffness joint_stiffness(const JointConfig& joint, Truncation mode, const Pair& length,
                                    const Pair& tension) noexcept {
  float flexor_tension = static_cast<float>(tension.flexor);
  float extensor_tension = joint.extensor.tension_ratio * static_cast<float>(tension.extensor);
  if (joint.stiffness_source == StiffnessSource::flexor_force) extensor_tension = flexor_tension;
  if (joint.stiffness_source == StiffnessSource::extensor_force) flexor_tension = extensor_tension;

  const Stiffness flexor = tension_share(joint.flexor, joint, mode, length.flexor, flexor_tension);
  const Stiffness extensor =
      tension_share(joint.extensor, joint, mode, length.extensor, extensor_tension);
  if (!flexor.valid || !extensor.valid) return {};
  const float six = 6.0f * joint.stiffness_factor * joint.moment_arm_factor;
  return {six * (flexor.value + extensor.value), true};
}

// Returns the stiffness of a joint whose muscles move with its own angle only.
constexpr Stiffness joint_stiffness(const JointConfig& joint, Truncation mode, std::int32_t angle,
                                    std::int32_t flexor_tension,
                                    std::int32_t extensor_tension) noexcept {
  return joint_stiffness(joint, mode, muscle_lengths(joint, angle),
                         {flexor_tension, extensor_tension});
}

// Returns the stiffness of one muscle by [26] and [30], from its gauge pressure, in lbf in/rad:
//
//   k = factor L p Eff(p)
//
// It has no pole, since it does not divide as [27] does. It is 0 at negative pressure.
constexpr float pressure_stiffness(const MuscleConfig& muscle, std::int32_t length,
                                   std::int32_t reading) noexcept {
  const float p = static_cast<float>(reading - muscle.pressure_at_zero);
  if (!muscle.present || !(p > 0)) return 0;
  const float low = p < muscle.valid_from ? muscle.valid_from : p;
  const float inside = low > muscle.valid_to ? muscle.valid_to : low;
  const auto& e = muscle.effectiveness;
  const float eff = e[0] + inside * (e[1] + inside * e[2]);
  return muscle.pressure_factor * static_cast<float>(length) * p * eff;
}

// Returns the stiffness of a joint by [60] and [26], from pressures in counts.
constexpr float joint_stiffness_from_pressure(const JointConfig& joint, const Pair& length,
                                              const Pair& pressure) noexcept {
  return pressure_stiffness(joint.flexor, length.flexor, pressure.flexor) +
         pressure_stiffness(joint.extensor, length.extensor, pressure.extensor);
}

inline constexpr float gain_limit = 1e6f;           // very small machines need thousands
inline constexpr float stiffness_limit = 1e6f;      // [lbf in/rad]
inline constexpr std::int32_t angle_limit = 32767;  // [count]

// Returns whether x is within the limit; false for NaN.
constexpr bool within(float x, float limit) noexcept { return x >= -limit && x <= limit; }

// Returns U_k of [58].
constexpr Exact stiffness_law(float gain, float desired, float actual) noexcept {
  return clamped(gain, gain_limit) *
         two_sum(clamped(desired, stiffness_limit), -clamped(actual, stiffness_limit));
}

// Returns U_theta of [59] with the velocity term of appendix B; velocity.h has the speed [count/s].
constexpr Exact angle_law(const Gains& gains, std::int8_t flexion, std::int32_t desired,
                          std::int32_t actual, float velocity) noexcept {
  const std::int32_t error = flexion * (clamped(desired, -angle_limit, angle_limit) - actual);
  const float speed = flexion > 0 ? velocity : 0.0f - velocity;
  return two_product(clamped(gains.angle, gain_limit), static_cast<float>(error)) -
         two_product(clamped(gains.velocity, gain_limit), speed);
}

// Clamps a duty to 0 .. 100; a negative duty means shut (thesis 5.1).
constexpr std::int32_t clipped(std::int32_t duty) noexcept {
  return clamped(duty, 0, signals::max_duty);
}

// Clamps a duty, and returns 0 below a dead band: pulses too short to open the valve only wear it.
constexpr std::int32_t clipped(std::int32_t duty, std::int32_t dead_band) noexcept {
  return duty < dead_band ? 0 : clipped(duty);
}

// Applies [54]-[57]: converts each muscle's signed duty to those of its two valves, at least
// one of which stays shut.
constexpr Duties to_duties(const Pair& signed_duties, std::int32_t dead_band = 0) noexcept {
  return {clipped(signed_duties.flexor, dead_band), clipped(-signed_duties.flexor, dead_band),
          clipped(signed_duties.extensor, dead_band), clipped(-signed_duties.extensor, dead_band)};
}

// Returns the signed duties of both muscles from the laws' real outputs [%], converted to whole
// percents according to the mode.
constexpr Pair signed_duties(Exact stiffness, Exact angle, Truncation mode) noexcept {
  switch (mode) {
    case Truncation::sum:
      return {truncated(stiffness + angle), truncated(stiffness - angle)};
    case Truncation::none:
      return {rounded(stiffness + angle), rounded(stiffness - angle)};
    case Truncation::each_law:
      break;
  }
  const std::int32_t u_k = truncated(stiffness), u_theta = truncated(angle);
  return {u_k + u_theta, u_k - u_theta};
}

// Returns the signed duty of a muscle over two joints: the mean of both joints' duties, weighted by
// its moment arms, r/(r + r_other). Equal duties are kept; with no arm at the other joint it is an
// ordinary muscle.
constexpr std::int32_t shared_duty(float share, std::int32_t own, float other_share,
                                   std::int32_t other, Truncation mode) noexcept {
  const Exact sum = two_product(share, static_cast<float>(own)) +
                    two_product(other_share, static_cast<float>(other));
  return mode == Truncation::none ? rounded(sum) : truncated(sum);
}

// Returns the duties of Robot III (5.1): a 3-way valve connects its muscle to the supply for the
// duty and to the room for the rest, so that the duty sets the pressure. `bias` is the duty at zero
// error. These valves never seal, so exhausts have no duties and a dead band does not apply.
constexpr Duties three_way_duties(std::int32_t bias, const Pair& signed_duties) noexcept {
  return {clipped(bias + signed_duties.flexor), 0, clipped(bias + signed_duties.extensor), 0};
}

// Returns the duties of appendix B's joint 0, position control of a double-acting cylinder. With
// feedforward on inlet and exhaust of one chamber both are open at once, by design: the constant
// flow stiffens the piston.
constexpr Duties cylinder_duties(const Duties& forward, Exact position, Truncation mode) noexcept {
  const std::int32_t u = mode == Truncation::none ? rounded(position) : truncated(position);
  return {clipped(forward.flexor_inlet + u), clipped(forward.flexor_exhaust - u),
          clipped(forward.extensor_inlet - u), clipped(forward.extensor_exhaust + u)};
}

// Returns duties that replace those of a law. A muscle's exhaust overrides its inlet (the thesis's
// code accepts any four duties); valves that never shut have no exhaust.
constexpr Duties open_loop_duties(const Duties& wanted, JointKind kind) noexcept {
  Duties d{clipped(wanted.flexor_inlet), clipped(wanted.flexor_exhaust),
           clipped(wanted.extensor_inlet), clipped(wanted.extensor_exhaust)};
  if (kind == JointKind::cylinder) return d;
  if (kind != JointKind::antagonist) return {d.flexor_inlet, 0, d.extensor_inlet, 0};
  if (d.flexor_exhaust > 0) d.flexor_inlet = 0;
  if (d.extensor_exhaust > 0) d.extensor_inlet = 0;
  return d;
}

}  // namespace sinew::control
