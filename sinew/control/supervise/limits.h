// control/supervise/limits.h - what the supervisor takes for possible; constant for a run.
//
// Everything is in the controller's own units: counts of the converter, ticks of 100 us. The
// defaults pass whatever a converter can say and whatever the laws can take, so that a supervisor
// without limits of its own only watches the clock.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "sinew/control/joint/config.h"
#include "sinew/control/joint/laws.h"
#include "sinew/signals/port.h"

namespace sinew::control {

// A reading outside [low, high], or further from the last good one than max_step times the scans
// since then, is rejected: the laws go on with the last good one.
struct SensorLimits {
  std::uint16_t low = 0, high = signals::max_counts;  // [count]
  std::uint16_t max_step = signals::max_counts;       // [count] from one scan to the next

  // A reading that repeats to the count while what it measures is driven. A gauge that stands at an
  // end of the converter may: slack, or clipped.
  std::uint32_t frozen_limit = 0;  // [scans] that end the run; 0: they are only counted
  std::int8_t joint = -1;   // whose valves move it; -1: nothing does, repeats are not counted
  bool of_flexor = true;    // by the flexor's valves
  bool of_extensor = true;  // by the extensor's
  bool rests_at_ends = false;
};

// A command outside is rejected as a whole: the last good one holds. Never wider than what the laws
// clamp at.
struct CommandLimits {
  std::int32_t low = -angle_limit, high = angle_limit;  // of the desired angle [count]
  std::int32_t max_step = 2 * angle_limit;              // [count] from one command to the next
  float max_stiffness = stiffness_limit;                // either sign [lbf in/rad]
  float max_gain = gain_limit;                          // either sign, of each gain
};

struct SuperviseConfig {
  std::array<SensorLimits, max_channels> sensor;  // by channel
  std::array<CommandLimits, max_joints> command;  // by joint

  // In a row:
  std::uint32_t bad_readings = 3;   // of a sensor that end the run
  std::uint32_t hold_commands = 3;  // rejected, from which on all valves are shut
  std::uint32_t vent_commands = 6;  // rejected, that end the run
  std::uint32_t frozen_scans = 50;  // equal readings, from which on they are counted as frozen

  // By how many ticks an announced tick came too late:
  std::uint32_t gap_shut = 2;    // from which on all inlets are shut
  std::uint32_t gap_vent = 100;  // from which on the run ends
};

// nullptr, or what is wrong, for a message.
const char* problem(const SuperviseConfig&) noexcept;

}  // namespace sinew::control
