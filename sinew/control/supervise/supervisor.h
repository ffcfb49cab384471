// control/supervise/supervisor.h - a joint controller with checks of its inputs.
//
// Wraps control::JointController with the same functions, so that a loop can use either. It checks
// readings, commands and the clock, and changes them only if something is wrong; otherwise the
// edges are those of the joint controller, bit for bit.
//
//   problem                         immediate effect                if it continues
//   a reading outside its range,    the last good one is kept       the third in a row: vent
//   or faster than possible
//   a reading that repeats itself   counted from the 50th on        vent, if its limit is set
//   while driven
//   a command: NaN, out of range    the last good one is kept       the third in a row: hold, all
//   or faster than allowed                                          valves shut; the sixth: vent
//   a tick later than announced     valves and laws that it         2 ticks: all inlets are shut;
//                                   skipped: shut until the         10 ms: vent
//                                   joint's next law
//
// Vent is the joint controller's shutdown without its delay: inlets shut and exhausts open from the
// next tick on, then all valves shut. It cannot be undone.
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

// Counts of the supervisor and its reason for ending a run, for the log and the summary.

struct SensorStatistics {
  std::uint16_t counts = 0;    // last conversion, accepted or not
  std::uint32_t rejected = 0;  // rejected readings
  std::uint32_t frozen = 0;    // scans in which it was equal for too long
  std::uint32_t longest = 0;   // longest sequence of equal readings while frozen
};

// Reason for the end of the run; fields that do not apply to the cause are 0. The last three causes
// are a board's (safety.h).
struct Trip {
  // Cause of the end.
  enum class Cause : std::uint8_t {
    none,
    range,
    rate,
    frozen,
    gap,
    command,
    host,       // silent for too long
    held,       // all valves were shut for the longest permitted time
    requested,  // shutdown was requested
  };

  Cause cause = Cause::none;
  signals::Tick at = 0;      // when the supervisor noticed
  signals::Channel channel;  // range, rate, frozen
  std::uint16_t counts = 0;  // reading; before = last good one
  std::uint16_t before = 0;  // [count]
  std::int32_t low = 0;      // the limit that was exceeded: range [count]; else `high`: rate
  std::int32_t high = 0;     // [count], frozen [scans], gap, host, held [ticks], command [commands]
  std::uint8_t joint = 0;    // command
};

// Counts of a run.
struct Supervised {
  std::array<SensorStatistics, max_channels> sensor;
  std::uint32_t rejected = 0;  // readings of all sensors
  std::uint32_t rejected_commands = 0;
  std::uint32_t gaps = 0;       // number of ticks that came later than announced
  std::uint32_t worst_gap = 0;  // longest delay [ticks]
  bool holding = false;         // all valves are shut: too many bad commands in a row
  std::uint32_t holds = 0;      // number of holds
  Trip trip;
};

class Supervisor {
 public:
  // Requires that problem() of both is nullptr.
  Supervisor(const JointControllerConfig& machine, const SuperviseConfig& limits) noexcept;

  // As in JointController; the first of these calls in a tick checks whether the tick is later than
  // announced.
  signals::Scan scan() const noexcept { return controller_.scan(); }
  signals::Tick next_event(signals::Tick t) noexcept;
  bool starts_period(signals::Tick t) noexcept;
  void command(const Command& command) noexcept;
  std::span<const signals::Edge> edges(signals::Tick t) noexcept;
  // Returns whether edges(t) will certainly return any, unless there is a command, a shutdown or a
  // late tick before.
  bool drives_at(signals::Tick t) const noexcept {
    return controller_.next_edge() <= t && !supervised_.holding &&
           bad_commands_ < limits_.vent_commands;
  }
  const signals::Conversion* due(signals::Tick t) noexcept;
  const signals::Conversion* begins(signals::Tick t) const noexcept {
    return controller_.begins(t);
  }
  void take(const signals::Conversion&, signals::Reading, signals::Tick t) noexcept;
  const ControllerState& state() const noexcept { return controller_.state(); }
  const JointControllerConfig& config() const noexcept { return controller_.config(); }
  void missed(signals::Tick t) noexcept { controller_.missed(t); }
  void shut_down(signals::Tick t) noexcept { controller_.shut_down(t); }

  // --- for a caller with further checks (safety.h) ---

  // Shuts all valves until the next good command.
  void hold() noexcept;

  // Requires that every tick is announced from now on, as by a board's timer: a missed tick is a
  // gap even if it had no event.
  void expect_every_tick() noexcept { every_tick_ = true; }

  // Vents from t on, without a law's delay.
  void end_run(Trip::Cause cause, std::uint32_t limit, signals::Tick t) noexcept;

  // Return the counts, and the limits in use.
  const Supervised& supervised() const noexcept { return supervised_; }
  const SuperviseConfig& limits() const noexcept { return limits_; }

 private:
  // State of the checks of one channel.
  struct Watch {
    std::uint16_t good = 0;    // last good reading [count]
    std::uint16_t scans = 1;   // scans since then, including the next one
    std::uint32_t agreed = 0;  // good readings so far, up to bad_readings
    std::uint32_t bad = 0;     // consecutive bad readings
    std::uint32_t equal = 0;   // consecutive equal readings while driven
  };

  bool active() const noexcept;
  void trip(const Trip& trip, signals::Tick vent_at) noexcept;

  // Clock
  void enter(signals::Tick t) noexcept;
  void gap(signals::Tick announced, signals::Tick t) noexcept;
  void skip(const signals::Conversion&, signals::Tick t) noexcept;

  // Readings
  void count_scan(signals::Channel) noexcept;
  Trip::Cause violated_limit(std::size_t channel, std::uint16_t counts) const noexcept;
  void accept(std::size_t channel, std::uint16_t counts) noexcept;
  void reject(signals::Channel, std::uint16_t counts, Trip::Cause, signals::Tick t) noexcept;
  bool driven(const SensorLimits&) const noexcept;
  void watch_frozen(signals::Channel, std::uint16_t counts, signals::Tick t) noexcept;

  // Commands
  bool possible(std::size_t joint, const JointCommand&) const noexcept;
  bool possible(const Openings&) const noexcept;
  void reject_command(std::uint8_t joint) noexcept;

  JointController controller_;
  SuperviseConfig limits_;
  Supervised supervised_;

  signals::Tick now_ = -1;  // last visited tick
  bool every_tick_ = false;
  std::array<Watch, max_channels> watch_;
  Command good_;                    // last good command
  bool commanded_ = false;          // there has been a good command
  std::uint32_t bad_commands_ = 0;  // consecutive bad commands
  std::uint8_t bad_joint_ = 0;      // joint of the last bad command
};

}  // namespace sinew::control
