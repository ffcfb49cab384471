// control/joint/command.h - command of the gait controller to the joint controller at the start of
// a period.
//
// All values are in the controller's own units: angles in counts of the converter, stiffness in lbf
// in/rad, duties in percent. Laws use a command from their next run on.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace sinew::control {

inline constexpr std::size_t max_joints = 8;

// Open times of a joint's four valves in whole percent of a period.
struct Duties {
  std::int32_t flexor_inlet = 0;      // [%] 0 .. 100
  std::int32_t flexor_exhaust = 0;    // [%]
  std::int32_t extensor_inlet = 0;    // [%]
  std::int32_t extensor_exhaust = 0;  // [%]

  friend constexpr bool operator==(const Duties&, const Duties&) = default;
};

// Part of a period in which a valve is open: from `from` on and before `until`. If `until` is
// smaller, the valve is open before `until` and from `from` on; if both are equal, it stays shut.
struct Opening {
  std::uint16_t from, until;  // ticks since the period's start, at most the period

  friend constexpr bool operator==(const Opening&, const Opening&) = default;
};
// Openings of the one actuator of a timed joint for one period. If the next command is late or
// lost, nothing opens.
struct Openings {
  Opening inlet, exhaust;
};

// Magnitudes below 1000; larger values and NaN are clamped.
struct Gains {
  float angle = 0;      // G_theta [%/count], of [59]
  float stiffness = 0;  // G_k [%/(lbf in/rad)], of [58]
  float velocity = 0;   // [% s/count], on the measured speed (appendix B)
};

// Setpoints of one joint for a period.
struct JointCommand {
  std::int32_t angle = 0;  // theta_des [count]
  float stiffness = 0;     // K_des [lbf in/rad]
  Gains gains;
  bool enabled = false;    // false: the law runs, its valves stay shut
  bool open_loop = false;  // true: `duties` replace the law's
  bool timed = false;      // true: `openings` are given instead of duties, for timed joints
  union {                  // only one is used; a board has little memory
    Duties duties{};       // a muscle's exhaust overrides its inlet
    Openings openings;
  };
};

struct Command {
  std::array<JointCommand, max_joints> joint;  // in the order of JointControllerConfig::joint
};

}  // namespace sinew::control
