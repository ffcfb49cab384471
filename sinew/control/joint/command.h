// control/joint/command.h - what the brain hands down to the spinal cord at the start of a period.
//
// Everything is in the controller's own units: angles in counts of the converter, stiffness in
// lbf in/rad, duties in percent. Laws use a command from their next run on.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace sinew::control {

inline constexpr std::size_t max_joints = 8;

// Open time of a joint's four valves in whole percent of a period.
struct Duties {
  std::int32_t flexor_inlet = 0;      // [%] 0 .. 100
  std::int32_t flexor_exhaust = 0;    // [%]
  std::int32_t extensor_inlet = 0;    // [%]
  std::int32_t extensor_exhaust = 0;  // [%]

  friend constexpr bool operator==(const Duties&, const Duties&) = default;
};

// Magnitudes below 1000; what is larger, or not a number, is clamped.
struct Gains {
  float angle = 0;      // G_theta [%/count], of [59]
  float stiffness = 0;  // G_k [%/(lbf in/rad)], of [58]
  float velocity = 0;   // [% s/count], on the measured speed (appendix B)
};

// Holds what is desired of one joint for a period.
struct JointCommand {
  std::int32_t angle = 0;  // theta_des [count]
  float stiffness = 0;     // K_des [lbf in/rad]
  Gains gains;
  bool enabled = false;    // false: the law runs, its valves stay shut
  bool open_loop = false;  // true: `duties` in place of the law's
  Duties duties;           // an exhaust shuts out its muscle's inlet
};

struct Command {
  std::array<JointCommand, max_joints> joint;  // in the order of JointControllerConfig::joint
};

}  // namespace sinew::control
