// control/supervise/supervisor.h - a spinal cord that does not believe everything.
//
// Stands before control::JointController with the same functions, so that the loop cannot tell. It
// looks at what comes in, readings, commands and the clock, and changes what goes on to the spinal
// cord only where something is wrong; where nothing is, the edges are the spinal cord's, bit for
// bit.
//
//   what is wrong                   at once                         going on
//   a reading outside its range,    the last good one is kept       the third in a row: vent
//   or faster than it can move
//   a reading that repeats itself   counted from the 50th on        vent, where its limit is set
//   while driven
//   a command: not a number, out    the last good one is kept       the third in a row: hold, all
//   of range, faster than allowed                                   valves shut; the sixth: vent
//   a tick later than announced     a valve or a law that it        2 ticks: all inlets are shut;
//                                   skipped: shut until the         10 ms: vent
//                                   joint's next law
//
// Vent is the spinal cord's shut-down without its delay: inlets shut and exhausts open from the
// next tick on, then all is shut. There is no way back.
//
// Embedded core: no heap, no exceptions, no clock, single precision.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "sinew/control/joint/config.h"
#include "sinew/control/joint/joint_controller.h"
#include "sinew/control/supervise/limits.h"
#include "sinew/signals/port.h"
#include "sinew/signals/tick.h"

namespace sinew::control {

// Holds what the supervisor has counted and why it ended a run, for the log and the summary.

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

// Holds the supervisor's counts of a run, and why it ended.
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

class Supervisor {
 public:
  // problem() of both must be nullptr.
  Supervisor(const JointControllerConfig& spine, const SuperviseConfig& limits) noexcept;

  // As of JointController; a tick that is later than announced is noticed by the first of its
  // calls.
  signals::Scan scan() const noexcept { return spine_.scan(); }
  signals::Tick next_event(signals::Tick t) noexcept;
  bool starts_period(signals::Tick t) noexcept;
  void command(const Command& command) noexcept;
  std::span<const signals::Edge> edges(signals::Tick t) noexcept;
  const signals::Conversion* due(signals::Tick t) noexcept;
  const signals::Conversion* begins(signals::Tick t) const noexcept { return spine_.begins(t); }
  void take(const signals::Conversion&, signals::Reading, signals::Tick t) noexcept;
  const Seen& seen() const noexcept { return spine_.seen(); }
  const JointControllerConfig& config() const noexcept { return spine_.config(); }
  void missed(signals::Tick t) noexcept { spine_.missed(t); }
  void shut_down(signals::Tick t) noexcept { spine_.shut_down(t); }

  // --- for who knows more than readings, commands and the clock (safety.h) ---

  // Shuts all valves until the next good command.
  void hold() noexcept;

  // From now on each tick is announced, as by a board's timer: one that is missed is a gap also
  // where nothing would have happened.
  void expect_every_tick() noexcept { every_tick_ = true; }

  // Vents from t on, without the delay of a law.
  void end_run(Trip::Cause cause, std::uint32_t limit, signals::Tick t) noexcept;

  // Returns what was counted; and the limits that it goes by.
  const Supervised& supervised() const noexcept { return supervised_; }
  const SuperviseConfig& limits() const noexcept { return limits_; }

 private:
  // Watch is the memory of one channel.
  struct Watch {
    std::uint16_t good = 0;    // the last good reading [count]
    std::uint16_t scans = 1;   // since then, the next one included
    std::uint32_t agreed = 0;  // good readings so far, counted up to bad_readings
    std::uint32_t bad = 0;     // in a row
    std::uint32_t equal = 0;   // in a row, that repeated themselves while driven
  };

  bool active() const noexcept;
  void trip(const Trip& trip, signals::Tick vent_at) noexcept;

  // Clock
  void enter(signals::Tick t) noexcept;
  void gap(signals::Tick announced, signals::Tick t) noexcept;
  void skip(const signals::Conversion&, signals::Tick t) noexcept;

  // Readings
  void count_scan(signals::Channel) noexcept;
  Trip::Cause judge(std::size_t channel, std::uint16_t counts) const noexcept;
  void believe(std::size_t channel, std::uint16_t counts) noexcept;
  void reject(signals::Channel, std::uint16_t counts, Trip::Cause, signals::Tick t) noexcept;
  bool driven(const SensorLimits&) const noexcept;
  void watch_frozen(signals::Channel, std::uint16_t counts, signals::Tick t) noexcept;

  // Commands
  bool possible(std::size_t joint, const JointCommand&) const noexcept;
  bool possible(const Openings&) const noexcept;
  void reject_command(std::uint8_t joint) noexcept;

  JointController spine_;
  SuperviseConfig limits_;
  Supervised supervised_;

  signals::Tick now_ = -1;  // the last visited tick
  bool every_tick_ = false;
  std::array<Watch, max_channels> watch_;
  Command good_;                    // the last good command
  bool commanded_ = false;          // there was one
  std::uint32_t bad_commands_ = 0;  // in a row
  std::uint8_t bad_joint_ = 0;      // of the last one
};

}  // namespace sinew::control
