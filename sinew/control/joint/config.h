// control/joint/config.h - what the spinal cord knows of its machine; constant for a run.
//
// Integers and single-precision numbers in the controller's own units: what the program of the
// thesis has as constants (appendix B). The defaults are the leg's hip, as far as joints share
// them.
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

// Lengths and angles in counts stay within it: 3 L^2 fits 32 bits, L a float  [count].
inline constexpr std::int32_t max_length = 20'000;
inline constexpr float max_tension_ratio = 1000, max_other_travel = 100, max_pressure_factor = 1;
inline constexpr std::int32_t max_thread_length_squared = (1 << 30) - 1;  // [count^2]

enum class JointKind : std::uint8_t {
  antagonist,  // two muscles, the laws [54]-[60]
  cylinder,    // an air cylinder with feedforward duties, appendix B's joint 0
  three_way,   // one valve per muscle, never sealed: its duty sets the pressure (Robot III, 5.1)
  regulated,   // a pressure regulator per muscle: regulator.h
  passive,     // an ankle without muscles and sensors: no law
  timed,       // one actuator, the flexor, without a law: the host gives the ticks of its valves
  timed_three_way,  // the same with one 3-way valve, which is an inlet
};

// Returns whether a host gives the ticks at which the joint's valves open.
constexpr bool is_timed(JointKind kind) noexcept {
  return kind == JointKind::timed || kind == JointKind::timed_three_way;
}
// Returns whether each muscle has an exhaust of its own. Only then do valves that are off hold the
// air.
constexpr bool has_exhausts(JointKind kind) noexcept {
  return kind == JointKind::antagonist || kind == JointKind::cylinder || kind == JointKind::timed;
}

// Where K_act of [58] comes from.
enum class StiffnessSource : std::uint8_t {
  force,           // both tensions [27]
  flexor_force,    // the flexor's tension, the extensor's taken for as large: no net torque
  extensor_force,  // the other way round
  pressure,        // both pressures [26], times the effectiveness
  none,            // no sensor: U_k is 0 (7.2)
};

// Where real percents become whole ones.
enum class Truncation : std::uint8_t {
  each_law,  // U_k and U_theta each towards zero, b^2/L whole: the code of the thesis
  sum,       // their sum towards zero
  none,      // their sum to the nearest percent; the schedule knows no parts of a percent
};

// A muscle as the low level knows it.
struct MuscleConfig {
  bool present = true;  // false: a spring or gravity pulls this way
  signals::Channel tension;
  signals::Valve inlet, exhaust;  // only some kinds of joints have an exhaust
  bool exhaust_inverted = false;  // its coil shuts it, B.1's "(3-way)" lines

  std::int32_t free_length =
      2416;  // length at the joint's rest angle [count], 3.15 in x 767 count/in
  std::int32_t thread_length_squared = 10465225;  // b^2 of [27] [count^2]
  float tension_ratio = 1;  // force of its count over that of the flexor's (stiffness_factor)

  // StiffnessSource::pressure, in counts of gauge pressure
  signals::Channel pressure;
  std::int32_t pressure_at_zero = 0;      // reading at the room's pressure [count]
  float pressure_factor = 0;              // 6 N r^2/(4 pi n^2) [lbf in/rad per count^2]
  std::array<float, 3> effectiveness{1};  // Eff(p) = e0 + e1 p + e2 p^2 [30]
  float valid_from = 0, valid_to = 4095;  // the effectiveness is held outside [count]

  // A muscle over two joints is named by both, with the same valves.
  float share = 1;         // of what this joint asks: r/(r + r_other) [-]
  float other_travel = 0;  // length gained per count of the other joint's angle [count/count]
};

// A joint as the low level knows it.
struct JointConfig {
  bool enabled = true;  // false: no command opens its valves
  JointKind kind = JointKind::antagonist;

  signals::Channel angle;
  MuscleConfig flexor, extensor;
  std::uint16_t law_tick = 0;  // [ticks] in the period: the conversion read here sets off the law

  std::int32_t angle_at_rest = 0;  // `potoffset` [count]
  std::int8_t flexion = +1;        // +1: flexion raises the angle; -1: lowers it
  bool lengths_swapped = false;    // stiffness law only: the lengths of flexor and extensor change
                                   // places. The code does so at the knee (`knee_lengths_swapped`)

  StiffnessSource stiffness_source = StiffnessSource::force;
  float stiffness_factor = 5.5f;   // counts of tension per count of length -> lbf/in
  float moment_arm_factor = 1.0f;  // what a moment arm other than 1 in adds to [60]
  std::int32_t pole_clamp =
      134;  // [count] the stiffness is held where a muscle is shorter than the
            // pole b/sqrt(3) of [27] plus this (10 deg). Far below zero, say
            // -10000: never, [27] is followed through its pole as in the code

  VelocityConfig velocity;    // of an antagonist, three_way or regulated joint
  RegulatorConfig regulator;  // regulated only
  std::int32_t bias = 50;     // three_way, regulated: duty or level without errors [%]

  Gains gains;         // until the brain sends its own
  Duties feedforward;  // cylinder: added by its law; antagonist: the first open-loop duties
};

// The channels that a joint's laws wait for.
struct Readings {
  std::array<signals::Channel, 6> channel;
  std::size_t count = 0;

  const signals::Channel* begin() const noexcept { return channel.data(); }
  const signals::Channel* end() const noexcept { return channel.data() + count; }
};
// Returns the channels that the joint's laws read.
Readings readings_of(const JointConfig&) noexcept;

// Everything that a board's controller is made with.
struct JointControllerConfig {
  std::array<JointConfig, max_joints> joint;
  std::size_t joints = 0;

  std::array<signals::Conversion, max_conversions> conversion;  // ascending in `read`
  std::size_t conversions = 0;

  std::uint16_t period = 100;      // [ticks], of the valves' pulses and of the scan
  std::uint16_t output_delay = 1;  // [ticks] from decision to edge, 1 .. period
  Truncation truncation = Truncation::each_law;
  signals::ValveTiming timing = signals::identity_timing();
  std::int32_t dead_band = 0;  // duties of sealing valves below it are 0 (B.1: "some value") [%]

  std::uint32_t startup_vent = 0;        // [ticks] all exhausts open, before the laws begin
  std::uint32_t shutdown_vent = 10'000;  // [ticks] the same before all valves stay shut
  std::uint32_t hold_limit = 0;  // bad readings of a channel in a row that end the run; 0: any

  // A law takes longer than the interrupt that runs it may (5.2: a hundredth of the period):
  // counted.
  bool laws_overrun = false;
};

// nullptr, or what is wrong, for a message. A JointController must not be made from a config with a
// problem.
const char* problem(const JointControllerConfig&) noexcept;

// What holds until the brain's first command: rest angles, no stiffness, joints disabled.
Command rest_command(const JointControllerConfig&) noexcept;

}  // namespace sinew::control
