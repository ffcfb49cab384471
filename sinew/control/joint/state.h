// control/joint/state.h - state of the joint controller, for the gait controller and the log.
#pragma once

#include <array>
#include <cstdint>

#include "sinew/control/joint/command.h"
#include "sinew/control/joint/config.h"
#include "sinew/signals/port.h"

namespace sinew::control {

// Phase of a run, from filling to rest.
enum class Phase : std::uint8_t {
  startup,  // all exhausts open, no law runs
  running,
  venting,  // shutdown was requested, or a fault: inlets shut, exhausts open
  off,      // all valves stay shut
};

// State at the joint's last law; zeros before the first.
struct JointState {
  signals::Tick law_at = -1;   // -1: no law has run yet
  float stiffness = 0;         // K_act [27], [60] [lbf in/rad]
  float stiffness_output = 0;  // U_k [58] [%], before truncation
  float angle_output = 0;      // U_theta [59] [%], before truncation
  float velocity = 0;          // estimated velocity [count/s]
  Duties duties;               // also computed while the joint is disabled
  Levels levels;               // instead of duties, for a regulated joint
  bool enabled = false;        // enabled at the law
  bool pole_held = false;      // a muscle is too near the pole of [27]: the stiffness is an old one
  std::uint32_t pole_holds = 0;  // laws with a held stiffness
};

struct ControllerState {
  Phase phase = Phase::startup;              // at the last visited tick
  std::array<JointState, max_joints> joint;  // in the order of the joints

  // last good counts, and the status of the last reading
  std::array<signals::Reading, max_channels> reading;

  std::uint32_t late = 0, invalid = 0;  // number of readings that were not good
  std::uint32_t missed = 0;             // number of ticks that the clock missed
  std::uint32_t overruns = 0;           // number of laws too long for their interrupt

  // reason for the end of the run; ok if it continues or shut_down() was called
  signals::Status fault = signals::Status::ok;
  signals::Channel fault_channel;
};

}  // namespace sinew::control
