// control/supervise/safety.h - states of a board from power-up on: when valves may move, which
// faults end that, and in which state they end (docs/reference/supervision.md has the table of
// faults).
//
//   fault --clear--> idle --arm, twice--> armed --command--> running
//                                                    running < hold < vent < dump
//
//   fault    all valves shut, the supply dumped; only a rising edge of `clear` without a present
//            fault leaves it. It is also the state after power-up
//   hold     all valves shut, no air moves; ends with the next good command
//   vent     inlets shut, exhausts open until the muscles are empty; then idle if it was
//            requested, else fault
//   dump     no current in any coil, at once, and the supply dumped; like fault, until `clear`
//
// Each fault leads to the mildest state that the table names for it; from there the state only
// becomes stricter, except for a good command (hold) or `clear`. Between commands the board behaves
// as the supervised controller, edge for edge. Its time counts from the first command, so that a
// simulation of the run is bit-identical.
//
//   each tick:   safety.begin(now);
//                if (safety.starts_period(now)) safety.command(latest, now);
//                for (const Edge& e : safety.edges(now)) log(e);
//                if (const Conversion* c = safety.due(now)) safety.take(*c, adc(c->channel), now);
//                valves = safety.word(now, active_low);
//                if (safety.end(now)) feed_watchdog();
//
// Embedded core: no heap, no exceptions, no clock, single precision.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "sinew/control/supervise/output_stage.h"
#include "sinew/control/supervise/supervisor.h"

namespace sinew::control {

// State of a board.
enum class BoardState : std::uint8_t { fault, idle, armed, running, hold, vent, dump };

// Reason for the current or last hold, vent, dump or fault.
enum class BoardFault : std::uint8_t {
  none,
  power_up,
  watchdog,    // it had expired before this start
  supervisor,  // a reading, a command or the clock; see Supervised::trip
  controller,  // missing readings; see ControllerState::fault
  host_silent,
  held_too_long,
  parameters,  // constants in memory have changed
  state,       // the state in memory has changed
  not_empty,   // a channel was still above its limit after the longest vent
  requested,   // a host requested it, at once or at its plan's end
};

struct SafetyConfig {
  std::uint32_t host_hold = 1'000;    // time without a command after which all valves shut [ticks]
  std::uint32_t host_vent = 10'000;   // time without a command that ends the run [ticks]
  std::uint32_t hold_limit = 20'000;  // duration of hold that ends the run [ticks]
  std::uint32_t arm_window = 10'000;  // longest time between the two frames of arming [ticks]

  // Venting lasts as long as the controller's own (shutdown_vent, or a second), for muscles without
  // a sensor. It then continues until every watched channel was at most `empty_at` in `empty_scans`
  // consecutive scans, but not longer than vent_limit.
  std::array<std::uint16_t, max_channels> empty_at{};  // [count]; 0: not watched
  std::uint32_t empty_scans = 3;
  std::uint32_t vent_limit = 50'000;  // [ticks]

  std::uint32_t check_every = 1'000;  // time in which all parameters are checked once [ticks]
  std::uint32_t refractory = 0;       // time for which a valve stays shut after it has shut [ticks]
};

// Return nullptr, or a problem for a message: of these numbers, or of the machine on a board.
const char* problem(const SafetyConfig&) noexcept;
const char* safety_problem(const JointControllerConfig&) noexcept;

class Safety {
 public:
  // State after a reset; `reset_by_watchdog`: the watchdog caused it.
  explicit Safety(bool reset_by_watchdog = false) noexcept;

  // Sets a machine's constants, in fault, idle or dump only. Returns nullptr, or the reason for
  // refusing; then the previous constants stay in effect.
  const char* configure(const JointControllerConfig&, const SuperviseConfig&,
                        const SafetyConfig&) noexcept;
  bool configured() const noexcept { return configured_; }
  // Returns the last configured machine.
  const JointControllerConfig& machine() const noexcept { return machine_; }

  // --- requests of a host; false: not permitted in this state ---

  // Leaves fault or dump for idle when `requested` becomes true and no fault is present.
  bool clear(bool requested, signals::Tick now) noexcept;
  bool arm_first(signals::Tick now) noexcept;
  bool arm_second(signals::Tick now) noexcept;
  // Sets the command, at a period's start or while armed; the first one starts the run.
  bool command(const Command&, signals::Tick now) noexcept;
  // Notes that the host is alive; an armed board requires this if no command comes.
  void note_host_alive(signals::Tick now) noexcept {
    if (state_ == BoardState::armed) host_alive_at_ = now;
  }
  void shut_down(signals::Tick now) noexcept;
  // Ends the plan at a period's start: vents as the controller does by itself, after a law's delay.
  void finish(signals::Tick now) noexcept;

  // --- a tick, in this order; ticks count from the reset and must not decrease ---

  void begin(signals::Tick now) noexcept;
  bool starts_period(signals::Tick now) noexcept;                    // of a run
  std::span<const signals::Edge> edges(signals::Tick now) noexcept;  // in ticks of the run
  // Returns the conversion to read, also outside a run, so that `clear` can check the sensors.
  const signals::Conversion* due(signals::Tick now) noexcept;
  // Returns the conversion that the hardware starts in this tick and that is read later. Called
  // after due().
  const signals::Conversion* begins(signals::Tick now) const noexcept;
  void take(const signals::Conversion&, signals::Reading, signals::Tick now) noexcept;
  OpenMask open(signals::Tick now) noexcept;
  // Returns the outputs' levels, for a driver that is active low or not; in a dump no coil has
  // current.
  std::uint32_t word(signals::Tick now, bool active_low) noexcept;
  // Returns whether the tick was complete and memory is unchanged, so that the watchdog may be fed.
  bool end(signals::Tick now) noexcept;

  // --- state ---

  // Return the state, and the reason for it.
  BoardState state() const noexcept { return state_; }
  BoardFault fault() const noexcept { return fault_; }
  // Returns whether the supply's dump valve has current. Without it, it lets the supply's air out.
  bool supply() const noexcept { return state_ != BoardState::dump && state_ != BoardState::fault; }
  const OutputStage& outputs() const noexcept { return out_; }
  // Returns a channel's last reading, in a run or outside.
  signals::Reading reading(std::size_t channel) const noexcept { return last_[channel]; }
  // Returns the ticks since the run's first command; -1 outside a run.
  signals::Tick run_tick(signals::Tick now) const noexcept { return runs() ? now - start_ : -1; }
  // Returns the controller of the current or last run; nullptr if there was none.
  const Supervisor* controller() const noexcept { return run_ ? &*run_ : nullptr; }

 private:
  bool runs() const noexcept {
    return state_ == BoardState::running || state_ == BoardState::hold ||
           state_ == BoardState::vent;
  }
  void enter(BoardState state) noexcept;
  void fail(BoardState state, BoardFault fault, signals::Tick now) noexcept;
  void vent(BoardFault, Trip::Cause, std::uint32_t limit, signals::Tick now) noexcept;
  void dump(BoardFault) noexcept;
  void watch_host(signals::Tick now) noexcept;
  void watch_run(signals::Tick now) noexcept;
  void watch_vent(signals::Tick now) noexcept;
  void end_vent() noexcept;
  void count_empty(std::size_t channel, signals::Reading) noexcept;
  bool watches_empty() const noexcept { return watched_ > 0; }
  bool sensors_good() const noexcept;
  void forget_sensors() noexcept;

  // Parameters
  struct Span {
    const void* at;
    std::uint32_t size;
  };
  static constexpr std::uint8_t spans = 5;
  Span parameters(std::uint8_t which) const noexcept;
  void next_parameters() noexcept;
  void check_parameters() noexcept;
  void restart_check() noexcept;

  BoardState state_ = BoardState::fault;
  std::uint8_t inverse_ = 0xff;  // complement of the state, to detect changed memory
  BoardFault fault_ = BoardFault::power_up;
  bool configured_ = false, clear_requested_ = true, first_frame_ = false;

  JointControllerConfig machine_;
  SuperviseConfig limits_;
  SafetyConfig config_;
  std::optional<Supervisor> run_;
  OutputStage out_;

  signals::Tick start_ = 0;  // start of the run
  signals::Tick host_alive_at_ = 0, armed_at_ = 0, held_since_ = 0, vent_since_ = 0;

  std::array<signals::Reading, max_channels> last_{};
  std::array<std::uint32_t, max_channels> empty_{};  // consecutive scans with an empty channel
  std::size_t watched_ = 0;
  std::size_t cursor_ = 0;       // next conversion outside a run
  std::uint16_t scan_tick_ = 0;  // tick of the scan outside a run

  // Check of the parameters: position, sum so far, and sum of the last complete check.
  std::uint32_t place_ = 0, sum_ = 0, checksum_ = 0, per_tick_ = 1;
  std::uint8_t span_ = 0;
  bool has_checksum_ = false;

  signals::Tick begun_ = -1, driven_ = -1, opened_ = -1;
  bool waiting_ = false;  // a reading is due
};

}  // namespace sinew::control
