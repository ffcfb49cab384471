// port/hardware/remote_board.h - a controller board at the other end of a line, as its host has
// it: who it is, what it was told, what it says.
//
//   RemoteBoard board(line, 1, 100);
//   board.prepare(configuration);              // to an armed board, or throws why not
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

// Says in words what a board did not do, and what may be done about it.
struct BoardError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Reports that a wait for a board was given up, as RemoteBoard::stop_when() requires.
struct BoardStopped : BoardError {
  // Has one text, as nothing has moved before a run begins.
  BoardStopped() : BoardError("interrupted before the run has begun; no valve has moved") {}
};

// Has a board that is found so to be looked into before it drives again? Its watchdog has bitten,
// its memory has changed, or a muscle did not let its air out.
constexpr bool is_grave(control::BoardFault fault) noexcept {
  using enum control::BoardFault;
  return fault == watchdog || fault == parameters || fault == state || fault == not_empty;
}

// "the board was in fault: readings did not come", of a board that prepare() found so; "" where it
// was only switched on, or left by its host.
std::string fault_found(const link::Identity& who);

class RemoteBoard {
 public:
  // `number` is the board's on its line, `period` that of its controller [ticks].
  RemoteBoard(BoardLine line, std::uint8_t number, std::uint16_t period);

  // --- before a run; each throws BoardError ---

  // From now on all that waits outside a run ends with BoardStopped as soon as this returns true.
  void stop_when(std::function<bool()> stops) { stops_ = std::move(stops); }
  // Asks who is there.
  link::Identity identify();
  // Sends the constants and has them taken, whole.
  void configure(const link::Configuration& configuration);
  // Leaves a latched fault: the board's sensors must be good.
  void clear_fault();
  // Lets it take a first command; valves still do not move.
  void arm();
  // All of it, with edges wanted. Refuses a board whose outputs have other levels than its valves'
  // drivers are said to take, and one whose fault somebody should look into, but for what the next
  // two allow. The identity is that of before: its state and fault were what is cleared.
  link::Identity prepare(const link::Configuration& configuration);
  // The drivers between its outputs and the coils take 0 for current, or 1. Never told: there are
  // no wires.
  void expect_levels(bool active_low) noexcept { expected_low_ = active_low; }
  // A fault that has to be looked into has been.
  void allow_clearing() noexcept { may_clear_ = true; }

  // Waits for the next telemetry, of a run or of none. nullptr: none came.
  const link::Telemetry* look(double seconds);

  // --- a run; no exceptions ---

  // False once the line is gone. The first command is sent again by next() while the board is still
  // armed: without one it never begins.
  bool command(const link::CommandFor& command) noexcept;
  // Waits for the next telemetry of a run, `seconds` at most. nullptr: none came; why() says why.
  const link::Telemetry* next(double seconds) noexcept;
  // Edges that it has told of since the last call, in the run's ticks and the board's numbers. The
  // span is valid until next().
  std::span<const signals::Edge> edges() noexcept;
  // Ends the run at once and waits for the valves to be at rest. True: the board says so.
  bool shut_down() noexcept;

  // --- after a run ---

  // The telemetry that the board keeps until it is armed again, oldest first, also what a spoiled
  // line never brought: of the 200 ms before its fault, or of a run's end where there was none.
  // Empty: nothing has run. Throws BoardError where it does not come whole.
  std::vector<link::Telemetry> fault_log();

  // --- for whoever looks ---

  // Why next() has returned nullptr: it ended, it is silent, or the line is gone.
  enum class Why : std::uint8_t { none, over, silent, gone };
  Why why() const noexcept { return why_; }
  // The line's time [s].
  double now() const noexcept { return line_.now(); }
  // The last state that it has told of, and why it is there.
  control::BoardState state() const noexcept { return state_; }
  control::BoardFault fault() const noexcept { return fault_; }
  // The last answer that was no `done`.
  const std::optional<link::Answer>& refusal() const noexcept { return refusal_; }
  const link::LineCount& line() const noexcept { return decoder_.line(); }
  // The line as the board has it, by its last telemetry.
  const link::LinkSeen& line_there() const noexcept { return line_there_; }

 private:
  template <class M>
  bool send(const M& message) noexcept;
  template <class M>
  link::Answer ask(const M& message);
  template <class M>
  void ask_until_done(const M& message, double seconds, const std::string& what);
  link::Answer transfer(const link::ConfigurationSender& sender);
  link::Answer arm_twice();

  bool work_off() noexcept;
  bool listen(double seconds) noexcept;
  void listen_or_throw(double seconds);
  bool is_seen(control::BoardState state, double seconds);
  void begin_again() noexcept;
  void hear(const link::Frame& frame) noexcept;
  void refuse_as_found(const link::Identity& who) const;
  void hear(const link::Edges& edges) noexcept;
  void hear(const link::FaultLog& record);
  [[noreturn]] void refuse(const link::Answer& answer, const std::string& what) const;

  BoardLine line_;
  std::uint8_t number_, sequence_ = 0;
  std::uint32_t configuration_ = 0;
  link::Decoder decoder_;
  link::TelemetryJoiner joiner_;
  std::array<std::uint8_t, 1024> bytes_{};
  std::size_t first_ = 0, end_ = 0;  // of bytes_, not decoded yet

  std::optional<link::Identity> identity_;
  std::optional<link::Answer> answer_, refusal_;
  const link::Telemetry* telemetry_ = nullptr;
  std::optional<std::uint8_t> other_version_;  // of the protocol, that the board speaks
  std::optional<bool> expected_low_;
  std::function<bool()> stops_;
  std::optional<link::CommandFor> beginning_;  // of a run, until the board runs
  double begins_again_ = 0;                    // when it is sent the next time [s]
  bool may_clear_ = false;
  bool has_run_ = false;
  Why why_ = Why::none;
  control::BoardState state_ = control::BoardState::fault;
  control::BoardFault fault_ = control::BoardFault::none;
  link::LinkSeen line_there_;
  std::vector<signals::Edge> edge_;
  std::vector<link::FaultLog> fault_log_;  // its records, from the first one on
  bool logged_all_ = false, wants_log_ = false;
};

}  // namespace sinew::plant
