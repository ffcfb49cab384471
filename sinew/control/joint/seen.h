// control/joint/seen.h - what the spinal cord knows of its body: for the brain and for the log.
#pragma once

#include <array>
#include <cstdint>

#include "sinew/control/joint/command.h"
#include "sinew/control/joint/config.h"
#include "sinew/signals/port.h"

namespace sinew::control {

// How far a run is, from filling up to rest.
enum class Phase : std::uint8_t {
  startup,  // all exhausts open, no law runs
  running,
  venting,  // asked to shut down, or a fault: inlets shut, exhausts open
  off,      // all valves shut for good
};

// Of the joint's last law; zeros before the first.
struct JointSeen {
  signals::Tick law_at = -1;   // -1: no law has run yet
  float stiffness = 0;         // K_act [27], [60] [lbf in/rad]
  float stiffness_output = 0;  // U_k [58] [%], before truncation
  float angle_output = 0;      // U_theta [59] [%], before truncation
  float velocity = 0;          // as estimated [count/s]
  Duties duties;               // computed also while the joint is disabled
  Levels levels;               // of a regulated joint, in place of the duties
  bool enabled = false;        // as the law found it
  bool pole_held = false;      // the stiffness is an old one: a muscle is too near the pole of [27]
  std::uint32_t pole_holds = 0;  // laws with a held stiffness
};

struct Seen {
  Phase phase = Phase::startup;  // as of the last visited tick
  std::array<JointSeen, max_joints> joint;

  // Last good counts, and the status of the last reading.
  std::array<signals::Reading, max_channels> reading;

  std::uint32_t late = 0, invalid = 0;  // readings so far that were not good
  std::uint32_t missed = 0;             // ticks the clock came too late for
  std::uint32_t overruns = 0;           // laws too long for their interrupt, laws_overrun

  // Why the run was ended: ok while it was not, or when shut_down() asked for it.
  signals::Status fault = signals::Status::ok;
  signals::Channel fault_channel;
};

}  // namespace sinew::control
