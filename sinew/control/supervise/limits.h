// control/supervise/limits.h - limits of the supervisor for readings, commands and ticks; constant
// for a run.
//
// All values are in the controller's own units: counts of the converter, ticks of 100 us. The
// defaults accept everything that a converter can return and the laws can use, so that by default
// the supervisor only checks the clock.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "sinew/control/joint/config.h"
#include "sinew/control/joint/laws.h"
#include "sinew/signals/port.h"

namespace sinew::control {

// Limits of a sensor. A reading outside [low, high], or further from the last good one than
// max_step times the scans since then, is rejected: the laws continue with the last good one.
struct SensorLimits {
  std::uint16_t low = 0, high = signals::max_counts;  // [count]
  std::uint16_t max_step = signals::max_counts;       // change from one scan to the next [count]

  // Detection of readings that are exactly equal while the measured quantity is driven. A gauge may
  // rest at an end of the converter: slack, or clipped.
  std::uint32_t frozen_limit = 0;  // scans that end the run; 0: they are only counted
  std::int8_t joint = -1;          // joint whose valves move it; -1: none, repeats are not counted
  bool of_flexor = true;           // moved by the flexor's valves
  bool of_extensor = true;         // moved by the extensor's valves
  bool rests_at_ends = false;
};

// Limits of a command. A command outside is rejected as a whole: the last good one stays in effect.
// They must not be wider than the limits to which the laws clamp.
struct CommandLimits {
  std::int32_t low = -angle_limit, high = angle_limit;  // desired angle [count]
  std::int32_t max_step = 2 * angle_limit;  // change from one command to the next [count]
  float max_stiffness = stiffness_limit;    // magnitude [lbf in/rad]
  float max_gain = gain_limit;              // magnitude of each gain
};

struct SuperviseConfig {
  std::array<SensorLimits, max_channels> sensor;  // indexed by channel
  std::array<CommandLimits, max_joints> command;  // indexed by joint

  // consecutive events:
  std::uint32_t bad_readings = 3;   // bad readings of a sensor that end the run
  std::uint32_t hold_commands = 3;  // rejected, after which all valves are shut
  std::uint32_t vent_commands = 6;  // rejected, that end the run
  std::uint32_t frozen_scans = 50;  // equal readings, from which on they are counted as frozen

  // ticks by which an announced tick came too late:
  std::uint32_t gap_shut = 2;    // all inlets are shut
  std::uint32_t gap_vent = 100;  // the run ends
};

// Returns nullptr, or a problem for a message.
const char* problem(const SuperviseConfig&) noexcept;

}  // namespace sinew::control
