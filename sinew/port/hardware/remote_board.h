// port/hardware/remote_board.h - a controller board at the other end of a line, seen from its host:
// its identity, commands to it and its telemetry.
//
//   RemoteBoard board(line, 1, 100);
//   board.prepare(configuration);              // arms the board, or throws
//   board.command({.from = 0, ...});           // starts the run
//   while (const link::Telemetry* t = board.next(1.0)) ...
//
// docs/reference/wire.md has the messages, docs/reference/supervision.md the board's states.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "sinew/control/link/configuration.h"
#include "sinew/control/link/telemetry.h"
#include "sinew/port/hardware/line.h"
#include "sinew/signals/port.h"

namespace sinew::plant {

// Reports what a board failed to do and what may be done about it.
struct BoardError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Reports that a wait for a board was given up because the function of RemoteBoard::stop_when()
// returned true.
struct BoardStopped : BoardError {
  // The text is always the same, since nothing has moved before a run begins.
  BoardStopped() : BoardError("interrupted before the run has begun; no valve has moved") {}
};

// Returns whether the cause of this fault has to be found before the board drives again: its
// watchdog has expired, its memory has changed, or a muscle did not empty.
constexpr bool needs_diagnosis(control::BoardFault fault) noexcept {
  using enum control::BoardFault;
  return fault == watchdog || fault == parameters || fault == state || fault == not_empty;
}

// Returns a text such as "the board was in fault: readings did not come" for a board that prepare()
// found in fault or dump; "" if it was only switched on or left by its host.
std::string fault_found(const link::Identity& who);

class RemoteBoard {
 public:
  // `number` is the board's number on its line, `period` that of its controller [ticks].
  RemoteBoard(BoardLine line, std::uint8_t number, std::uint16_t period);

  // --- before a run; each throws BoardError ---

  // Ends every wait outside a run with BoardStopped as soon as `stops` returns true.
  void stop_when(std::function<bool()> stops) { stops_ = std::move(stops); }
  // Requests the board's identity.
  link::Identity identify();
  // Sends the whole configuration and has the board adopt it.
  void configure(const link::Configuration& configuration);
  // Leaves a latched fault: the board's sensors must be good.
  void clear_fault();
  // Arms the board: it then accepts a first command. Valves do not move yet.
  void arm();
  // Does all of the above and requests edges. Refuses a board whose output levels differ from
  // those of its valves' drivers, and one with a fault whose cause has to be found; the next two
  // functions change this. Returns the identity from before, with the state and fault that were
  // cleared.
  link::Identity prepare(const link::Configuration& configuration);
  // Sets the level at which the drivers between outputs and coils give current: low (0) or high
  // (1). If this is not called, levels are not checked.
  void expect_levels(bool active_low) noexcept { expected_low_ = active_low; }
  // Permits prepare() to clear a fault whose cause has to be found.
  void allow_clearing() noexcept { may_clear_ = true; }

  // Waits for the next telemetry, in a run or outside. Returns nullptr if none arrived.
  const link::Telemetry* wait_for_telemetry(double seconds);

  // --- a run; no exceptions ---

  // Returns false once the line is closed. next() sends the first command again while the board is
  // still armed: a lost first command would otherwise never start the run.
  bool command(const link::CommandFor& command) noexcept;
  // Waits for the next telemetry of a run, at most `seconds`. Returns nullptr if none arrived;
  // why() has the reason.
  const link::Telemetry* next(double seconds) noexcept;
  // Returns the edges that the board has reported since the last call of next(), in the run's ticks
  // and the board's numbers. The span is valid until the next call of next().
  std::span<const signals::Edge> edges() noexcept;
  // Ends the run at once and waits for the valves to be at rest. Returns whether the board reports
  // so.
  bool shut_down() noexcept;

  // --- after a run ---

  // Returns the telemetry that the board keeps until it is armed again, oldest first, including
  // records that were lost on the line: the 200 ms before its fault, or before a run's end without
  // a fault. Empty: nothing has run. Throws BoardError if the log is incomplete.
  std::vector<link::Telemetry> fault_log();

  // --- state ---

  // Reason why next() has returned nullptr: the run is over, the board is silent, or the line is
  // gone.
  enum class Why : std::uint8_t { none, over, silent, closed };
  Why why() const noexcept { return why_; }
  // The line's time [s].
  double now() const noexcept { return line_.now(); }
  // Return the last state that the board has reported, and its cause.
  control::BoardState state() const noexcept { return state_; }
  control::BoardFault fault() const noexcept { return fault_; }
  // Returns the last reply other than `done`.
  const std::optional<link::Reply>& refusal() const noexcept { return refusal_; }
  const link::LineCount& line() const noexcept { return decoder_.line(); }
  // Returns the board's view of the line, from its last telemetry.
  const link::LinkStatistics& line_there() const noexcept { return line_there_; }

 private:
  template <class M>
  bool send(const M& message) noexcept;
  template <class M>
  link::Reply request(const M& message);
  template <class M>
  void request_until_done(const M& message, double seconds, const std::string& what);
  link::Reply transfer(const link::ConfigurationSender& sender);
  link::Reply arm_twice();

  bool process_frames() noexcept;
  bool listen(double seconds) noexcept;
  void listen_or_throw(double seconds);
  bool is_seen(control::BoardState state, double seconds);
  void begin_again() noexcept;
  void handle_frame(const link::Frame& frame) noexcept;
  void refuse_as_found(const link::Identity& who) const;
  void store_edges(const link::Edges& edges) noexcept;
  void store_log_record(const link::FaultLog& record);
  [[noreturn]] void refuse(const link::Reply& reply, const std::string& what) const;

  BoardLine line_;
  std::uint8_t number_, sequence_ = 0;
  std::uint32_t configuration_ = 0;
  link::Decoder decoder_;
  link::TelemetryJoiner joiner_;
  std::array<std::uint8_t, 1024> bytes_{};
  std::size_t first_ = 0, end_ = 0;  // part of bytes_ that is not decoded yet

  std::optional<link::Identity> identity_;
  std::optional<link::Reply> reply_, refusal_;
  const link::Telemetry* telemetry_ = nullptr;
  std::optional<std::uint8_t> other_version_;  // protocol version of a board of another version
  std::optional<bool> expected_low_;
  std::function<bool()> stops_;
  std::optional<link::CommandFor> beginning_;  // first command, until the board runs
  double begins_again_ = 0;                    // time at which it is sent again [s]
  bool may_clear_ = false;
  bool has_run_ = false;
  Why why_ = Why::none;
  control::BoardState state_ = control::BoardState::fault;
  control::BoardFault fault_ = control::BoardFault::none;
  link::LinkStatistics line_there_;
  std::vector<signals::Edge> edge_;
  std::vector<link::FaultLog> fault_log_;  // records in order, from the first one on
  bool logged_all_ = false, wants_log_ = false;
};

}  // namespace sinew::plant
