// run/controllers/boards.h - the low level of a machine: one controller per board, each with its
// own numbering and scan, driven together in the machine's numbering.
//
// Within a tick the boards are served in the order of their numbers: first all their edges, then
// all their conversions. If one board ends its run, the others are shut down in the same tick. A
// machine with one board behaves like that board, bit for bit.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "sinew/control/setup/boards.h"
#include "sinew/robot/robot.h"
#include "sinew/run/controllers/board.h"
#include "sinew/signals/port.h"

namespace sinew::run {

class Boards;

// View of the state of all boards in the machine's numbering. The boards must outlive it.
class MachineState {
 public:
  // Views the present state of the boards.
  explicit MachineState(const Boards& boards) noexcept;

  control::Phase phase;  // the least advanced phase of all boards

  // Return the state of a joint in the robot's order, followed by the cylinder's, or of a sensor in
  // the robot's order.
  const control::JointState& joint(std::size_t joint) const noexcept;
  const signals::Reading& reading(std::size_t sensor) const noexcept;
  const control::SensorStatistics& supervised(std::size_t sensor) const noexcept;

  // Return the counters of all boards, and whether one has ended the run: sums; for gaps, which all
  // boards count alike, the largest.
  std::uint32_t overruns() const noexcept;
  std::uint32_t rejected_commands() const noexcept;
  std::uint32_t gaps() const noexcept;
  bool tripped() const noexcept;

 private:
  const Boards* boards_;
};

// The last counters of all boards: sums; for missed ticks, which all boards count alike, the
// largest.
struct ControllerTotals {
  control::Phase phase = control::Phase::startup;
  std::uint32_t late = 0, invalid = 0, missed = 0, overruns = 0;
  signals::Status fault = signals::Status::ok;  // status of the board that ended the run
  signals::Channel fault_channel;               // in the machine's numbering
};

// The readings and commands that were rejected on any board, and why the run ended.
struct SupervisedTotals {
  std::vector<control::SensorStatistics> sensor;  // in the robot's order
  std::uint32_t rejected = 0, rejected_commands = 0;
  std::uint32_t gaps = 0, worst_gap = 0;
  control::Trip trip;  // reported by the board that ended the run, with the machine's numbers
  int board = 1;       // its number
};

class Boards {
 public:
  // Creates the controllers of the boards of one machine (run/setup/installation.h).
  explicit Boards(std::span<const control::Board> boards);

  // --- used by the loop ---

  // Returns the scan of all boards, ascending in `read`, and in the boards' order within a tick.
  // The span points into this object.
  signals::Scan scan() const noexcept { return {period_, conversion_}; }
  std::span<Board> each() noexcept { return boards_; }
  MachineState state() const noexcept { return MachineState(*this); }
  // Returns the least advanced phase of all boards.
  control::Phase phase() const noexcept {
    control::Phase least = boards_.front().state().phase;
    for (const Board& b : each())
      if (b.state().phase < least) least = b.state().phase;
    return least;
  }
  void command(const MachineCommand& command) noexcept;
  // Returns whether a board certainly drives a valve at t (control/supervise/supervisor.h).
  bool drives_at(signals::Tick t) const noexcept {
    for (const Board& b : each())
      if (b.supervisor.drives_at(t)) return true;
    return false;
  }
  // Returns the first tick after t at which any board has an event. Ends the run of all boards if
  // one has ended.
  signals::Tick next_event(signals::Tick t) noexcept;
  void missed(signals::Tick t) noexcept;
  void shut_down(signals::Tick t) noexcept;

  // --- used for a machine with one remote board (remote_boards.h) ---

  // Ticks from `first` on, before `last`.
  struct Ticks {
    signals::Tick first = 0, last = 0;
  };
  // Sets the state of the board in these ticks, which replaces that of its local controller.
  void show(const control::ControllerState& controller, const control::Supervised& supervised,
            Ticks valid) noexcept;
  // Records that its run is over; `why` is ok if the board has reported the end itself.
  void show_end(signals::Status why) noexcept;
  // Returns whether the shown state is that of tick t; always true for local boards.
  bool has_state_of(signals::Tick t) const noexcept {
    return t >= valid_ticks_.first && t < valid_ticks_.last;
  }

  // --- used by observers ---

  // Return the boards, in the order of their numbers, and their counters taken together.
  std::span<const Board> each() const noexcept { return boards_; }
  ControllerTotals controller_totals() const;
  SupervisedTotals supervised_totals() const;

  // --- saving: the complete state of the boards, copied as bytes ---

  // Return the size of the state in bytes; write it; restore it.
  std::size_t state_size() const noexcept;
  void save(std::span<std::byte> out) const noexcept;
  void restore(std::span<const std::byte> saved) noexcept;

 private:
  friend class MachineState;

  // The board of a joint or a sensor, and its number there.
  struct Place {
    std::uint8_t board = 0, number = 0;
  };
  // State that is not part of a board's.
  struct State {
    int ended_by = -1;  // the first board that ended the run
  };

  void end_together(signals::Tick t) noexcept;

  std::vector<Board> boards_;
  std::vector<signals::Conversion> conversion_;
  std::array<Place, robot::max_joints + 1> joint_;
  std::vector<Place> sensor_;
  std::uint16_t period_ = 100;
  Ticks valid_ticks_{0, std::numeric_limits<signals::Tick>::max()};
  State state_;
};

}  // namespace sinew::run
