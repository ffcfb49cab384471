// run/simulation/remote_boards.h - boards at the other end of a line as the loop's low level and
// its body: commands go down once a period, what the board knows comes up and is shown where
// simulated boards would show theirs. Time is the board's: the loop waits for its telemetry.
//
//   period      0              1              2
//   up                  what it knows     what it knows
//   down        command        command        command      for `lead` periods later
//
// Over a real line a command is on its way while its period begins, so it is sent one period ahead
// (lead 1: the plan comes one period later than in a simulation: 10 ms, or a test stand's
// drive.period). Where the board waits for the host
// (lead 0, an emulator in lock step) it is the simulation's, bit for bit.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "sinew/experiment/experiment.h"
#include "sinew/port/hardware/remote_board.h"
#include "sinew/run/controllers/boards.h"

namespace sinew::run {

// Returns the board that drives an experiment's machine. Throws std::invalid_argument where there
// are several.
control::Board only_board(const experiment::Experiment& experiment);

// Returns the description of the machine that the board needs. The board waits for three periods,
// at least, until it takes the host for lost.
link::Configuration configuration_of(const experiment::Experiment& experiment);

// As before, for a board at a machine: where the robot bears any number of readings that do not
// come, three of a channel in a row end the run; and where the pressure of a muscle with valves is
// measured, a vent goes on until it is below 2 psi gauge, and ends in a dump where it is not after
// vent_limit. A simulation may try what a cable must not.
link::Configuration bench_configuration_of(const experiment::Experiment& experiment);

class RemoteBoards final : public signals::Port {
 public:
  // The board is armed; it and `shown` outlive this.
  RemoteBoards(Boards& shown, plant::RemoteBoard& board, int lead);

  // --- the loop's low level ---

  // Returns the scan and the last word of the board as if it were here, and takes the command of a
  // period.
  signals::Scan scan() const noexcept { return shown_->scan(); }
  MachineSeen seen() const noexcept { return shown_->seen(); }
  void command(const MachineCommand& command) noexcept;
  // Sends the period's command and waits for what the board says of it. Returns the first tick that
  // comes after what it said: a period whose telemetry is lost is left out.
  signals::Tick next_event(signals::Tick t) noexcept;
  void missed(signals::Tick) noexcept {}  // the board counts its own
  void shut_down(signals::Tick) noexcept { ends_ = true; }

  // The board, as far as the loop asks: its edges, each once.
  struct Told {
    RemoteBoards* of;
    // Answers the loop: edges that the board has told of; nothing to convert here.
    std::span<const signals::Edge> edges(signals::Tick) noexcept { return of->edges(); }
    const signals::Conversion* due(signals::Tick) noexcept { return nullptr; }
    void take(const signals::Conversion&, signals::Reading, signals::Tick) noexcept {}
  };
  std::span<Told> each() noexcept { return told_; }

  // --- the body: the board has valves and sensors ---

  signals::Status start(const signals::Scan&) noexcept override { return signals::Status::ok; }
  signals::Status drive(signals::Edge) noexcept override { return signals::Status::ok; }
  signals::Reading read(signals::Channel, signals::Tick) noexcept override { return {}; }
  // Vents the board where it still runs.
  signals::Status stop(signals::Tick) noexcept override;

  // Returns the edges before the tick `end`, at which the run is over, that the loop did not visit.
  std::span<const signals::Edge> last_edges(signals::Tick end) noexcept;

  // --- for whoever looks ---

  std::uint32_t lost() const noexcept { return lost_; }  // periods of which nothing came
  // Edges and periods that were left out: of a valve or at a time that the board does not have.
  std::uint32_t foreign() const noexcept { return foreign_; }
  // Why the run ended before its end, where that was the line's or the board's doing; else empty.
  std::string problem() const;

 private:
  std::span<const signals::Edge> edges() noexcept;
  bool send(signals::Tick t) noexcept;
  void take_edges(signals::Tick t) noexcept;

  Boards* shown_;
  plant::RemoteBoard* board_;
  signals::Tick period_, lead_, last_read_ = 0;
  std::vector<std::uint8_t> joint_, valve_;  // the machine's numbers, by the board's own
  MachineCommand command_;
  signals::Tick next_ = 0;  // of the next telemetry: nothing happens before
  bool ends_ = false, end_sent_ = false, over_ = false;
  std::uint32_t lost_ = 0, foreign_ = 0;
  std::vector<signals::Edge> edges_;
  bool handed_on_ = false;
  std::array<Told, 1> told_;
};

}  // namespace sinew::run
