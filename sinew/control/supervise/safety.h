// control/supervise/safety.h - a board's states, from power-up to the next one: when valves may
// move at all, what ends that, and how far it goes (docs/reference/supervision.md has the table of
// faults).
//
//   fault --clear--> idle --arm, twice--> armed --command--> running
//                                                    running < hold < vent < dump
//
//   fault    all valves shut, the supply dumped; only a rising edge of `clear`, while healthy,
//   leaves
//            it. Power-up is one
//   hold     all valves shut, nothing in, nothing out; ends with the next good command
//   vent     inlets shut, exhausts open until the muscles are empty; then idle where it was asked
//            for, else fault
//   dump     at once no current in any coil and the supply dumped; as a fault, until `clear`
//
// Each fault goes to the mildest state that its table names and from there only further, never back
// without a good command (hold) or `clear`. Between commands it is the supervised controller, edge
// for edge: time in it counts from the first command, so that a simulation of that run has the same
// bits.
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

// How far valves may move, from not at all to as they are told.
enum class BoardState : std::uint8_t { fault, idle, armed, running, hold, vent, dump };

// Why the board is, or last was, in hold, vent, dump or fault.
enum class BoardFault : std::uint8_t {
  none,
  power_up,
  watchdog,    // it had bitten before this start
  supervisor,  // a reading, a command or the clock: Supervised::trip says which
  controller,  // readings that did not come: Seen::fault
  host_silent,
  held_too_long,
  parameters,  // the constants in memory have changed
  state,       // so has the state itself
  not_empty,   // after the longest vent something was still under pressure
  asked,       // a host has: at once, or at its plan's end
};

struct SafetyConfig {
  std::uint32_t host_hold = 1'000;    // [ticks] without a command, from which on all is shut
  std::uint32_t host_vent = 10'000;   // [ticks] without one, that end the run
  std::uint32_t hold_limit = 20'000;  // [ticks] of hold, that end the run
  std::uint32_t arm_window = 10'000;  // [ticks] from the first of the two frames to the second

  // Venting lasts as long as the controller's own (shutdown_vent, or a second), for what nobody
  // measures; and on until every watched channel was at most `empty_at` in so many scans in a row,
  // but no longer than vent_limit.
  std::array<std::uint16_t, max_channels> empty_at{};  // [count]; 0: not watched
  std::uint32_t empty_scans = 3;
  std::uint32_t vent_limit = 50'000;  // [ticks]

  std::uint32_t check_every = 1'000;  // [ticks] in which all parameters are looked at once
  std::uint32_t refractory = 0;       // [ticks] for which a valve that has shut stays shut
};

// nullptr, or what is wrong, for a message: of these numbers, or of the machine on such a board.
const char* problem(const SafetyConfig&) noexcept;
const char* safety_problem(const JointControllerConfig&) noexcept;

class Safety {
 public:
  // After a reset; `bitten`: it was the watchdog's.
  explicit Safety(bool bitten = false) noexcept;

  // Takes a machine's constants, in fault, idle or dump only. Returns nullptr, or why not; then
  // what was there before holds, nothing at first.
  const char* configure(const JointControllerConfig&, const SuperviseConfig&,
                        const SafetyConfig&) noexcept;
  bool configured() const noexcept { return configured_; }
  // The machine that it was configured for last.
  const JointControllerConfig& machine() const noexcept { return machine_; }

  // --- what a host asks; false: not in this state ---

  // Leaves fault or dump for idle when `wish` rises while nothing is wrong.
  bool clear(bool wish, signals::Tick now) noexcept;
  bool arm_first(signals::Tick now) noexcept;
  bool arm_second(signals::Tick now) noexcept;
  // At a period's start, or while armed; the first one starts the run.
  bool command(const Command&, signals::Tick now) noexcept;
  // The host lives: what an armed board waits for beside commands.
  void heard(signals::Tick now) noexcept {
    if (state_ == BoardState::armed) heard_at_ = now;
  }
  void shut_down(signals::Tick now) noexcept;
  // The plan is over, at a period's start: vents as the controller does by itself, a law's delay
  // later.
  void finish(signals::Tick now) noexcept;

  // --- a tick, in this order; ticks count from the reset and never decrease ---

  void begin(signals::Tick now) noexcept;
  bool starts_period(signals::Tick now) noexcept;                    // of a run
  std::span<const signals::Edge> edges(signals::Tick now) noexcept;  // in ticks of the run
  // Also while nothing runs, so that `clear` knows the sensors.
  const signals::Conversion* due(signals::Tick now) noexcept;
  // The conversion that hardware starts in this tick, to be read in a later one; after due().
  const signals::Conversion* begins(signals::Tick now) const noexcept;
  void take(const signals::Conversion&, signals::Reading, signals::Tick now) noexcept;
  OpenMask open(signals::Tick now) noexcept;
  // As coils, of a driver that is active low or not; in a dump none has current.
  std::uint32_t word(signals::Tick now, bool active_low) noexcept;
  // The whole tick was worked off and nothing has changed by itself: the watchdog may be fed.
  bool end(signals::Tick now) noexcept;

  // --- for whoever looks ---

  // Returns how far valves may move, and why not further.
  BoardState state() const noexcept { return state_; }
  BoardFault fault() const noexcept { return fault_; }
  // Has the supply's dump valve current? Without, it lets the supply's air out.
  bool supply() const noexcept { return state_ != BoardState::dump && state_ != BoardState::fault; }
  const OutputStage& outputs() const noexcept { return out_; }
  // A channel's last reading, whether something runs or not.
  signals::Reading reading(std::size_t channel) const noexcept { return last_[channel]; }
  // Ticks since the run's first command; -1: there was none since the board was armed.
  signals::Tick run_tick(signals::Tick now) const noexcept { return runs() ? now - start_ : -1; }
  // What runs or has run last; nullptr before.
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
  std::uint8_t inverse_ = 0xff;  // of the state, to know it by
  BoardFault fault_ = BoardFault::power_up;
  bool configured_ = false, wished_ = true, first_frame_ = false;

  JointControllerConfig machine_;
  SuperviseConfig limits_;
  SafetyConfig config_;
  std::optional<Supervisor> run_;
  OutputStage out_;

  signals::Tick start_ = 0;  // of the run
  signals::Tick heard_at_ = 0, armed_at_ = 0, held_since_ = 0, vent_since_ = 0;

  std::array<signals::Reading, max_channels> last_{};
  std::array<std::uint32_t, max_channels> empty_{};  // scans in a row
  std::size_t watched_ = 0;
  std::size_t cursor_ = 0;       // conversions while nothing runs
  std::uint16_t scan_tick_ = 0;  // of a scan of its own then

  // Of the parameters: how far this look is, its sum, and what the last one had.
  std::uint32_t place_ = 0, sum_ = 0, known_ = 0, per_tick_ = 1;
  std::uint8_t span_ = 0;
  bool known_yet_ = false;

  signals::Tick begun_ = -1, driven_ = -1, opened_ = -1;
  bool waiting_ = false;  // for a reading that is due
};

}  // namespace sinew::control
