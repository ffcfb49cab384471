// signals/port.h - interface between a controller's loop and a body.
//
// Simulated worlds, a recorded log and real cards implement it (world/, port/, firmware/); the
// controller has no access to it. The only loop that connects the two is run/simulation/loop.h.
//
//   order within a tick: period start (commands of the high level), edges decided earlier,
//                        the due conversion. Ticks never decrease.
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

inline constexpr std::uint16_t max_counts = 4095;  // 12-bit converter, 4.1
inline constexpr std::uint16_t max_level = 4095;   // set point of a regulator, 12 bits as well

// Result of a conversion, and its status.
struct Reading {
  std::uint16_t counts = 0;  // the last good value unless status == ok
  Status status = Status::ok;
};

// One conversion of the scan. The value is sampled at `start`; the result is available at `read`.
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
  bool open = false;        // regulator: whether the set point is above 0
  std::uint16_t level = 0;  // set point of a regulator, 0 .. max_level; on/off valves ignore it
};

class Port {
 public:
  // Called once, before the loop. Errors of configuration are thrown earlier, by the constructor.
  virtual Status start(const Scan&) noexcept = 0;

  // Switches a valve. At equal ticks edges come before conversions; the ticks of both never
  // decrease.
  virtual Status drive(Edge) noexcept = 0;

  // Returns the result of the conversion that began at `start` of the current period. Reading never
  // changes the motion: a simulated body computes it in a copy and commits no step.
  virtual Reading read(Channel, Tick now) noexcept = 0;

  // Leaves every valve in the safe state (vent, then shut) from `now` on; also after a fault.
  virtual Status stop(Tick now) noexcept = 0;

 protected:
  ~Port() = default;  // not deleted through the base: no operator delete in the firmware
};

}  // namespace sinew::signals
