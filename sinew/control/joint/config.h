// control/joint/config.h - description of the machine for the joint controller; constant for a run.
//
// Integers and single-precision numbers in the controller's own units: the constants of the
// thesis's program (appendix B). The defaults are those of the leg's hip where the joints have
// equal values.
//
//   hip, knee: flexion +1, -1   law_tick 9, 13   angle_at_rest 1895, 1175
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "sinew/control/joint/command.h"
#include "sinew/control/joint/regulator.h"
#include "sinew/control/joint/velocity.h"
#include "sinew/signals/port.h"
#include "sinew/signals/timing.h"

namespace sinew::control {

inline constexpr std::size_t max_conversions = 32;
inline constexpr std::size_t max_channels = 32;

// Limit of lengths and angles: 3 L^2 fits 32 bits, and L is exact as a float [count].
inline constexpr std::int32_t max_length = 20'000;
inline constexpr float max_tension_ratio = 1000, max_other_travel = 100, max_pressure_factor = 1;
inline constexpr std::int32_t max_thread_length_squared = (1 << 30) - 1;  // [count^2]

enum class JointKind : std::uint8_t {
  antagonist,  // two muscles, the laws [54]-[60]
  cylinder,    // an air cylinder with feedforward duties, appendix B's joint 0
  three_way,   // one 3-way valve per muscle, never sealed: duty sets pressure (Robot III, 5.1)
  regulated,   // a pressure regulator per muscle (regulator.h)
  passive,     // an ankle without muscles, sensors and law
  timed,       // one actuator, the flexor, without a law: the host sets the ticks of its valves
  timed_three_way,  // as timed, with one 3-way valve, which is an inlet
};

// Returns whether a host sets the ticks at which the joint's valves open.
constexpr bool is_timed(JointKind kind) noexcept {
  return kind == JointKind::timed || kind == JointKind::timed_three_way;
}
// Returns whether each muscle has a separate exhaust. Only then do valves without current hold the
// air.
constexpr bool has_exhausts(JointKind kind) noexcept {
  return kind == JointKind::antagonist || kind == JointKind::cylinder || kind == JointKind::timed;
}

// Source of K_act in [58].
enum class StiffnessSource : std::uint8_t {
  force,           // both tensions [27]
  flexor_force,    // the flexor's tension; the extensor's is assumed to be equal (no net torque)
  extensor_force,  // the extensor's tension; the flexor's is assumed to be equal
  pressure,        // both pressures [26], times the effectiveness
  none,            // no sensor: U_k is 0 (7.2)
};

// Conversion of the laws' real outputs to whole percents.
enum class Truncation : std::uint8_t {
  each_law,  // U_k and U_theta are each truncated towards zero, b^2/L is whole: the thesis's code
  sum,       // their sum is truncated towards zero
  none,      // their sum is rounded: the schedule has whole percents only
};

// A muscle in the low level's units.
struct MuscleConfig {
  bool present = true;  // false: a spring or gravity pulls this way
  signals::Channel tension;
  signals::Valve inlet, exhaust;  // exhaust: only for some kinds of joints
  bool exhaust_inverted = false;  // current shuts the exhaust, "(3-way)" in B.1

  std::int32_t free_length =
      2416;  // length at the joint's rest angle [count], 3.15 in x 767 count/in
  std::int32_t thread_length_squared = 10465225;  // b^2 of [27] [count^2]
  float tension_ratio = 1;  // force per count relative to the flexor's (stiffness_factor)

  // for StiffnessSource::pressure, in counts of gauge pressure
  signals::Channel pressure;
  std::int32_t pressure_at_zero = 0;      // reading at the room's pressure [count]
  float pressure_factor = 0;              // 6 N r^2/(4 pi n^2) [lbf in/rad per count^2]
  std::array<float, 3> effectiveness{1};  // Eff(p) = e0 + e1 p + e2 p^2 [30]
  float valid_from = 0, valid_to = 4095;  // range of the effectiveness's argument [count]

  // A muscle over two joints is in the configuration of both, with the same valves.
  float share = 1;         // this joint's share of the duty: r/(r + r_other) [-]
  float other_travel = 0;  // change of length per count of the other joint's angle [count/count]
};

// A joint in the low level's units.
struct JointConfig {
  bool enabled = true;  // false: no command opens its valves
  JointKind kind = JointKind::antagonist;

  signals::Channel angle;
  MuscleConfig flexor, extensor;
  std::uint16_t law_tick = 0;  // in the period: the conversion read here starts the law [ticks]

  std::int32_t angle_at_rest = 0;  // `potoffset` [count]
  std::int8_t flexion = +1;        // +1: flexion raises the angle; -1: lowers it
  bool lengths_swapped = false;  // stiffness law only: exchanges lengths of flexor and extensor, as
                                 // the thesis's code does at the knee (`knee_lengths_swapped`)

  StiffnessSource stiffness_source = StiffnessSource::force;
  float stiffness_factor = 5.5f;   // counts of tension per count of length -> lbf/in
  float moment_arm_factor = 1.0f;  // factor of [60] for moment arms other than 1 in
  std::int32_t pole_clamp =
      134;  // the stiffness keeps its value if a muscle is shorter than the pole
            // b/sqrt(3) of [27] plus this (10 deg) [count]. Far below zero, such as
            // -10000: never, [27] is computed through its pole as in the thesis's code

  VelocityConfig velocity;    // for antagonist, three_way and regulated joints
  RegulatorConfig regulator;  // regulated only
  std::int32_t bias = 50;     // three_way, regulated: duty or level at zero error [%]

  Gains gains;         // in effect until the gait controller sends others
  Duties feedforward;  // cylinder: added by its law; antagonist: initial open-loop duties
};

// Channels that a joint's laws need.
struct Readings {
  std::array<signals::Channel, 6> channel;
  std::size_t count = 0;

  const signals::Channel* begin() const noexcept { return channel.data(); }
  const signals::Channel* end() const noexcept { return channel.data() + count; }
};
// Returns the channels that the joint's laws read.
Readings readings_of(const JointConfig&) noexcept;

// Everything that a board's controller is constructed from.
struct JointControllerConfig {
  std::array<JointConfig, max_joints> joint;
  std::size_t joints = 0;

  std::array<signals::Conversion, max_conversions> conversion;  // ascending in `read`
  std::size_t conversions = 0;

  std::uint16_t period = 100;      // period of the valves' pulses and of the scan [ticks]
  std::uint16_t output_delay = 1;  // delay of an edge after its decision, 1 .. period [ticks]
  Truncation truncation = Truncation::each_law;
  signals::ValveTiming timing = signals::identity_timing();
  std::int32_t dead_band = 0;  // smaller duties of sealing valves become 0 (B.1: "some value") [%]

  std::uint32_t startup_vent = 0;        // all exhausts open before the laws begin [ticks]
  std::uint32_t shutdown_vent = 10'000;  // all exhausts open before all valves shut [ticks]
  std::uint32_t hold_limit = 0;  // bad readings in a row that end the run, by channel; 0: no limit

  // Counts laws as overruns: a law takes longer than the interrupt that runs it may (5.2: a
  // hundredth of the period).
  bool laws_overrun = false;
};

// Returns nullptr, or a problem of the configuration for a message. A JointController must not be
// constructed from a configuration with a problem.
const char* problem(const JointControllerConfig&) noexcept;

// Returns the command that is in effect before the first one arrives: rest angles, zero stiffness,
// joints disabled.
Command rest_command(const JointControllerConfig&) noexcept;

}  // namespace sinew::control
