// run/simulation/remote_boards.h - a board at the other end of a line as the loop's low level and
// as its body. Commands are sent once a period; the board's reported state replaces that of a
// simulated board. The board determines the time: the loop waits for its telemetry.
//
//   period      0              1              2
//   up                  state          state
//   down        command        command        command      for `lead` periods later
//
// A real line needs time to transmit a command, so it is sent one period ahead (lead 1: the plan is
// one period later than in a simulation: 10 ms, or a test stand's drive.period). If the board waits
// for the host (lead 0, an emulator in lock step), the run equals the simulation, bit for bit.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "sinew/control/link/telemetry.h"
#include "sinew/experiment/experiment.h"
#include "sinew/port/hardware/remote_board.h"
#include "sinew/run/controllers/boards.h"

namespace sinew::run {

// Returns the board that drives an experiment's machine. Throws std::invalid_argument if there are
// several.
control::Board only_board(const experiment::Experiment& experiment);

// Returns the description of the machine that the board needs. The board considers the host lost
// after at least three periods without a command.
link::Configuration configuration_of(const experiment::Experiment& experiment);

// Returns the same for a board at a real machine, with stricter limits. If the robot tolerates any
// number of missing readings, three in a row on one channel end the run. If the pressure of a
// muscle with valves is measured, a vent continues until it is below 2 psi gauge, and ends in a
// dump if it is not after vent_limit.
link::Configuration bench_configuration_of(const experiment::Experiment& experiment);

class RemoteBoards final : public signals::Port {
 public:
  // The board must be armed; it and `shown` must outlive this object.
  RemoteBoards(Boards& shown, plant::RemoteBoard& board, int lead);

  // --- the low level of the loop ---

  // Return the scan and the last reported state of the board, like a local board; take the
  // command of a period.
  signals::Scan scan() const noexcept { return shown_->scan(); }
  MachineState state() const noexcept { return shown_->state(); }
  void command(const MachineCommand& command) noexcept;
  // Sends the period's command and waits for the board's report. Returns the tick of the report; a
  // period whose telemetry is lost is left out.
  signals::Tick next_event(signals::Tick t) noexcept;
  void missed(signals::Tick) noexcept {}  // the board counts missed ticks itself
  void shut_down(signals::Tick) noexcept { ends_ = true; }

  // The board as the loop uses it: it returns each reported edge once.
  struct RemoteBoardView {
    RemoteBoards* of;
    // Called by the loop. Nothing is converted here.
    std::span<const signals::Edge> edges(signals::Tick) noexcept { return of->edges(); }
    const signals::Conversion* due(signals::Tick) noexcept { return nullptr; }
    void take(const signals::Conversion&, signals::Reading, signals::Tick) noexcept {}
  };
  std::span<RemoteBoardView> each() noexcept { return views_; }

  // --- the body: valves and sensors are at the board ---

  signals::Status start(const signals::Scan&) noexcept override { return signals::Status::ok; }
  signals::Status drive(signals::Edge) noexcept override { return signals::Status::ok; }
  signals::Reading read(signals::Channel, signals::Tick) noexcept override { return {}; }
  // Vents the board if it still runs.
  signals::Status stop(signals::Tick) noexcept override;

  // Returns the reported edges before the tick `end` of the run that the loop has not visited.
  std::span<const signals::Edge> last_edges(signals::Tick end) noexcept;

  // --- used by observers ---

  std::uint32_t lost() const noexcept { return lost_; }  // periods without telemetry
  // Returns the number of edges and periods that were discarded, since they name a valve or a
  // time that the board does not have.
  std::uint32_t foreign() const noexcept { return foreign_; }
  // Returns why the line or the board ended the run early; empty if they did not.
  std::string problem() const;

 private:
  std::span<const signals::Edge> edges() noexcept;
  bool send(signals::Tick t) noexcept;
  void take_edges(signals::Tick t) noexcept;

  Boards* shown_;
  plant::RemoteBoard* board_;
  signals::Tick period_, lead_, last_read_ = 0;
  std::vector<std::uint8_t> joint_, valve_;  // the machine's numbers, indexed by the board's own
  MachineCommand command_;
  signals::Tick next_ = 0;  // tick of the next telemetry; there is no event before
  bool ends_ = false, end_sent_ = false, over_ = false;
  std::uint32_t lost_ = 0, foreign_ = 0;
  std::vector<signals::Edge> edges_;
  bool handed_on_ = false;
  std::array<RemoteBoardView, 1> views_;
};

// Returns a board's record of the 200 ms before its fault as CSV with a line per period, oldest
// first, for a robot on one board: the run's time [s], the board's state and its cause, and the
// number of accepted host frames; per sensor the last good reading, as converted, and the readings
// rejected so far [count]; per joint its speed [count/s], the outputs of the laws and duties [%].
std::string fault_log_csv(std::span<const link::Telemetry> log, const experiment::Experiment& e);

}  // namespace sinew::run
