// signals/port.h - what a controller's loop may ask of a body.
//
// Simulated worlds, a recorded log and real cards implement it (world/, port/, firmware/); the
// controller never sees it. The one loop that joins the two is run/simulation/loop.h.
//
//   order within a tick: period start (commands of the high level), edges decided earlier,
//                        the conversion due. Ticks never decrease.
#pragma once

#include <cstdint>
#include <span>

#include "sinew/signals/tick.h"

namespace sinew::signals {

struct Channel {
  std::uint8_t index = 0;  // position in the robot's list of sensors
};

struct Valve {
  std::uint8_t index =
      0;  // 2 x muscle + (0 inlet | 1 exhaust); a 3-way valve uses its inlet's index
};

enum class Status : std::uint8_t { ok, late, invalid, ended, fault };  // ended and fault are sticky

inline constexpr std::uint16_t max_counts = 4095;  // of the 12-bit converter, 4.1
inline constexpr std::uint16_t max_level = 4095;   // of a regulator's set point, 12 bits as well

// Holds what a conversion has given, and whether it may be believed.
struct Reading {
  std::uint16_t counts = 0;  // the last good value unless status == ok
  Status status = Status::ok;
};

// One conversion of the scan. The sampled instant is `start`; the result is there at `read`.
struct Conversion {
  Channel channel;
  std::uint16_t start = 0, read = 0;  // [ticks] within the period, start < read
};

// Constant for a run: hardware starts conversions ahead, batches share the ticks, replay checks it.
struct Scan {
  std::uint16_t period = 100;               // [ticks]
  std::span<const Conversion> conversions;  // ascending in `read`
};

// An electrical edge; the valve's own delay belongs to the body.
struct Edge {
  Tick at = 0;  // acts on [at, infinity)
  Valve valve;
  bool open = false;        // of a regulator: is the set point above 0?
  std::uint16_t level = 0;  // set point of a regulator, 0 .. max_level; on/off valves ignore it
};

class Port {
 public:
  // Once, before the loop. Errors of configuration were thrown earlier, by the constructor.
  virtual Status start(const Scan&) noexcept = 0;

  // Edges first, then conversions, both with non-decreasing ticks.
  virtual Status drive(Edge) noexcept = 0;

  // Result of the conversion that began at `start` of the current period. Reading never changes
  // the motion: a simulated body answers from a copy, it does not commit a step.
  virtual Reading read(Channel, Tick now) noexcept = 0;

  // Leaves every valve in the safe state (vent, then shut) from `now` on; also after a fault.
  virtual Status stop(Tick now) noexcept = 0;

 protected:
  ~Port() = default;  // never deleted through the base: no operator delete in the firmware
};

}  // namespace sinew::signals
