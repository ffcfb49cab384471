// run/controllers/boards.h - the low level of a machine: one controller per board, each with its
// own numbers and its own scan, driven together under the machine's numbers.
//
// Within a tick the boards come in the order of their numbers: first all of their edges, then all
// of their conversions. What ends one board's run ends the machine's: the others are shut down in
// the same tick. A machine of one board is that board, bit for bit.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "sinew/control/setup/boards.h"
#include "sinew/control/supervise/supervisor.h"
#include "sinew/robot/robot.h"
#include "sinew/signals/port.h"

namespace sinew::run {

// One board before the machine's port: what goes in and out has the machine's numbers.
class Board {
 public:
  // Makes the controller of that board.
  explicit Board(const control::Board& board);

  // As of control::Supervisor.
  std::span<const signals::Edge> edges(signals::Tick t) noexcept;
  const signals::Conversion* due(signals::Tick t) noexcept;
  // The conversion is one that due() gave.
  void take(const signals::Conversion&, signals::Reading, signals::Tick t) noexcept;

  // Returns its scan, and the machine's numbers of its joints, channels and valves, by its own.
  std::span<const signals::Conversion> conversions() const noexcept { return conversion_; }
  std::span<const std::uint8_t> joints() const noexcept { return joint_; }
  std::span<const std::uint8_t> channels() const noexcept { return channel_; }
  std::span<const std::uint8_t> valves() const noexcept { return valve_; }

  // What it knows: its controller's, or what a board far away has said last.
  const control::Seen& seen() const noexcept { return far_ ? far_->seen : supervisor.seen(); }
  const control::Supervised& supervised() const noexcept {
    return far_ ? far_->supervised : supervisor.supervised();
  }
  struct Far {
    control::Seen seen;
    control::Supervised supervised;
  };
  void show(const Far& far) noexcept { far_ = far; }
  // Why it ended the run, with the machine's channel and joint.
  control::Trip trip() const noexcept;

  control::Supervisor supervisor;

 private:
  std::vector<std::uint8_t> joint_, channel_, valve_;  // the machine's numbers, by the board's own
  std::vector<signals::Conversion> conversion_;        // its scan
  std::array<signals::Edge, 4 * control::max_joints> out_;
  std::optional<Far> far_;
};

// A command says what is desired of every joint of the machine, in the robot's order, and of the
// cylinder's behind them; for a test stand, of its element.
using MachineCommand = std::array<control::JointCommand, robot::max_joints + 1>;

class Boards;

// Answers what all boards know, by the machine's numbers. It looks at the boards, which outlive it.
class MachineSeen {
 public:
  // Looks at these boards.
  explicit MachineSeen(const Boards& boards) noexcept;

  control::Phase phase;  // of the board that is least far

  // A joint in the robot's order, or the cylinder's behind them; a sensor in the robot's order.
  const control::JointSeen& joint(std::size_t joint) const noexcept;
  const signals::Reading& reading(std::size_t sensor) const noexcept;
  const control::SensorSeen& supervised(std::size_t sensor) const noexcept;

  // Returns the counters of all boards together, and whether one has ended the run.
  std::uint32_t overruns() const noexcept;
  std::uint32_t rejected_commands() const noexcept;
  std::uint32_t gaps() const noexcept;
  bool tripped() const noexcept;

 private:
  const Boards* boards_;
};

// The last word of all boards: their counters together. Of what all of them notice alike, ticks
// that came too late, the highest count of one.
struct SeenTotals {
  control::Phase phase = control::Phase::startup;
  std::uint32_t late = 0, invalid = 0, missed = 0, overruns = 0;
  signals::Status fault = signals::Status::ok;  // of the board that ended the run
  signals::Channel fault_channel;               // the machine's
};

// Holds what was not believed on any board, and why the run ended.
struct SupervisedTotals {
  std::vector<control::SensorSeen> sensor;  // in the robot's order
  std::uint32_t rejected = 0, rejected_commands = 0;
  std::uint32_t gaps = 0, worst_gap = 0;
  control::Trip trip;  // of the board that ended the run, with the machine's numbers
  int board = 1;       // its number
};

class Boards {
 public:
  // Makes the controllers of these boards of one machine (run/setup/installation.h).
  explicit Boards(std::span<const control::Board> boards);

  // --- for the loop ---

  // Returns the scan of all boards, ascending in `read`; at one tick in the boards' order. The span
  // points into this object.
  signals::Scan scan() const noexcept { return {period_, conversion_}; }
  std::span<Board> each() noexcept { return boards_; }
  MachineSeen seen() const noexcept { return MachineSeen(*this); }
  void command(const MachineCommand& command) noexcept;
  // The first tick after t at which anything happens on any board. Ends the run of all boards where
  // one has ended.
  signals::Tick next_event(signals::Tick t) noexcept;
  void missed(signals::Tick t) noexcept;
  void shut_down(signals::Tick t) noexcept;

  // --- for a machine whose one board is far away (remote_boards.h) ---

  // Ticks from `first` on, before `last`.
  struct Ticks {
    signals::Tick first = 0, last = 0;
  };
  // Shows what it knew in these ticks, in place of its controller here.
  void show(const control::Seen& seen, const control::Supervised& supervised, Ticks known) noexcept;
  // Its run is over; `why` is ok where it has said so itself.
  void show_end(signals::Status why) noexcept;
  // Is what is seen that of tick t? Always, of boards that are here.
  bool knows(signals::Tick t) const noexcept { return t >= known_.first && t < known_.last; }

  // --- for whoever looks ---

  // Returns the boards, in the order of their numbers; and what they have counted, together.
  std::span<const Board> each() const noexcept { return boards_; }
  SeenTotals seen_totals() const;
  SupervisedTotals supervised_totals() const;

  // --- for whoever saves: everything that the boards' future depends on, copied like bytes ---

  // Returns how many bytes it takes; writes so many; goes on from them.
  std::size_t state_size() const noexcept;
  void save(std::span<std::byte> out) const noexcept;
  void restore(std::span<const std::byte> saved) noexcept;

 private:
  friend class MachineSeen;

  // A joint or a sensor: its board, and its number there.
  struct Place {
    std::uint8_t board = 0, number = 0;
  };
  // Its own state, beside the boards'.
  struct State {
    int ended_by = -1;  // the first board that ended the run
  };

  void end_together(signals::Tick t) noexcept;

  std::vector<Board> boards_;
  std::vector<signals::Conversion> conversion_;
  std::array<Place, robot::max_joints + 1> joint_;
  std::vector<Place> sensor_;
  std::uint16_t period_ = 100;
  Ticks known_{0, std::numeric_limits<signals::Tick>::max()};
  State state_;
};

}  // namespace sinew::run
