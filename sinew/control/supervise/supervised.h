// control/supervise/supervised.h - what the supervisor has counted, and why it ended a run: for the
// log, the summary and whoever asks afterwards.
#pragma once

#include <array>
#include <cstdint>

#include "sinew/control/joint/config.h"
#include "sinew/signals/port.h"
#include "sinew/signals/tick.h"

namespace sinew::control {

struct SensorSeen {
  std::uint16_t counts = 0;    // as converted last, whether it was believed or not
  std::uint32_t rejected = 0;  // readings that were not believed
  std::uint32_t frozen = 0;    // scans in which it repeated itself for too long
  std::uint32_t longest = 0;   // of them, in a row
};

// Why the run was ended; what is not of the cause is 0. The last three are a board's (safety.h).
struct Trip {
  // Names what was not believed any more.
  enum class Cause : std::uint8_t {
    none,
    range,
    rate,
    frozen,
    gap,
    command,
    host,   // silent for too long
    held,   // all valves were shut for as long as they may be
    asked,  // shut down at once, by whoever may ask
  };

  Cause cause = Cause::none;
  signals::Tick at = 0;      // when the supervisor knew
  signals::Channel channel;  // range, rate, frozen
  std::uint16_t counts = 0;  // that it read there; before = last good ones
  std::uint16_t before = 0;  // [count]
  std::int32_t low = 0;      // the limit that was broken: range [count]; else `high`: rate
  std::int32_t high = 0;     // [count], frozen [scans], gap, host, held [ticks], command [commands]
  std::uint8_t joint = 0;    // command
};

struct Supervised {
  std::array<SensorSeen, max_channels> sensor;
  std::uint32_t rejected = 0;  // readings of all sensors
  std::uint32_t rejected_commands = 0;
  std::uint32_t gaps = 0;       // ticks that came later than announced
  std::uint32_t worst_gap = 0;  // [ticks] too late
  bool holding = false;         // all valves are shut: too many commands in a row were bad
  std::uint32_t holds = 0;      // how often
  Trip trip;
};

}  // namespace sinew::control
