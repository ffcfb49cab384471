// run/controllers/board.h - one board of a machine's low level, as the loop uses it. It is copied
// as bytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>

#include "sinew/control/supervise/supervisor.h"
#include "sinew/robot/robot.h"
#include "sinew/signals/port.h"
#include "sinew/signals/short_list.h"

namespace sinew::run {

// The commands of all joints of the machine, in the robot's order, followed by that of the
// cylinder; for a test stand, that of its element.
using MachineCommand = std::array<control::JointCommand, robot::max_joints + 1>;

// One board behind the machine's port: its inputs and outputs have the machine's numbers.
class Board {
 public:
  // Creates the controller of the board, whose lists are no longer than those here.
  Board(const control::JointControllerConfig& config, const control::SuperviseConfig& limits,
        std::span<const std::uint8_t> joints, std::span<const std::uint8_t> channels,
        std::span<const std::uint8_t> valves);

  // Like those of control::Supervisor.
  std::span<const signals::Edge> edges(signals::Tick t) noexcept;
  const signals::Conversion* due(signals::Tick t) noexcept;
  // Passes a reading to the controller. The conversion must be one that due() has returned.
  void take(const signals::Conversion&, signals::Reading, signals::Tick t) noexcept;

  // Returns its part of the machine's command.
  control::Command own(const MachineCommand& command) const noexcept {
    control::Command its;
    for (std::size_t j = 0; j < joint_.size(); ++j) its.joint[j] = command[joint_[j]];
    return its;
  }

  // Return its scan, and the machine's numbers of its joints, channels and valves, indexed by its
  // own.
  std::span<const signals::Conversion> conversions() const noexcept { return conversion_; }
  std::span<const std::uint8_t> joints() const noexcept { return joint_; }
  std::span<const std::uint8_t> channels() const noexcept { return channel_; }
  std::span<const std::uint8_t> valves() const noexcept { return valve_; }

  // Return the state of its controller, or the last state that a remote board has reported.
  const control::ControllerState& state() const noexcept {
    return reported_ ? reported_->controller : supervisor.state();
  }
  const control::Supervised& supervised() const noexcept {
    return reported_ ? reported_->supervised : supervisor.supervised();
  }
  struct ReportedState {
    control::ControllerState controller;
    control::Supervised supervised;
  };
  void show(const ReportedState& reported) noexcept { reported_ = reported; }
  // Returns why it ended the run, with the machine's channel and joint.
  control::Trip trip() const noexcept;

  control::Supervisor supervisor;

 private:
  template <std::size_t most>
  using Numbers = signals::ShortList<std::uint8_t, most>;

  // The machine's numbers, indexed by the board's own, and its scan.
  Numbers<control::max_joints + 1> joint_;
  Numbers<control::max_channels> channel_;
  Numbers<4 * control::max_joints> valve_;
  signals::ShortList<signals::Conversion, control::max_conversions> conversion_;
  std::array<signals::Edge, 4 * control::max_joints> out_;
  std::optional<ReportedState> reported_;
};

static_assert(std::is_trivially_copyable_v<Board>);

}  // namespace sinew::run
