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
#include "sinew/signals/port.h"
#include "sinew/signals/timing.h"

namespace sinew::control {

inline constexpr std::size_t max_conversions = 16;
inline constexpr std::size_t max_channels = 16;

enum class JointKind : std::uint8_t {
  antagonist,  // two muscles, the laws [54]-[60]
  cylinder,    // an air cylinder with feedforward duties, appendix B's joint 0
};

// Where real percents become whole ones.
enum class Truncation : std::uint8_t {
  each_law,  // U_k and U_theta each towards zero, b^2/L whole: the code of the thesis
  sum,       // their sum towards zero
  none,      // their sum to the nearest percent; the schedule knows no parts of a percent
};

struct MuscleConfig {
  signals::Channel tension;
  signals::Valve inlet, exhaust;
  std::int32_t free_length =
      2416;  // length at the joint's rest angle [count], 3.15 in x 767 count/in
};

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

  std::int32_t thread_length_squared = 10465225;  // b^2 of [27] [count^2]
  float stiffness_factor = 5.5f;                  // counts of tension per count of length -> lbf/in
  float moment_arm_factor = 1.0f;                 // what a moment arm other than 1 in adds to [60]
  std::int32_t pole_clamp =
      134;  // [count] the stiffness is held where a muscle is shorter than the
            // pole b/sqrt(3) of [27] plus this (10 deg). Far below zero, say
            // -10000: never, [27] is followed through its pole as in the code

  Gains gains;         // until the brain sends its own
  Duties feedforward;  // cylinder: added by its law; antagonist: the first open-loop duties
};

struct SpineConfig {
  std::array<JointConfig, max_joints> joint;
  std::size_t joints = 0;

  std::array<signals::Conversion, max_conversions> conversion;  // ascending in `read`
  std::size_t conversions = 0;

  std::uint16_t period = 100;      // [ticks], of the valves' pulses and of the scan
  std::uint16_t output_delay = 1;  // [ticks] from decision to edge, 1 .. period
  Truncation truncation = Truncation::each_law;
  signals::ValveTiming timing = signals::identity_timing();

  std::uint32_t startup_vent = 0;        // [ticks] all exhausts open, before the laws begin
  std::uint32_t shutdown_vent = 10'000;  // [ticks] the same before all valves stay shut
  std::uint32_t hold_limit = 0;  // bad readings of a channel in a row that end the run; 0: any
};

// nullptr, or what is wrong, for a message. A Spine must not be made from a config with a problem.
const char* problem(const SpineConfig&) noexcept;

// What holds until the brain's first command: rest angles, no stiffness, joints disabled.
Command rest_command(const SpineConfig&) noexcept;

}  // namespace sinew::control
