#include "sinew/run/controllers/boards.h"

#include <algorithm>
#include <cstring>

namespace sinew::run {

using control::Phase;
using signals::Conversion;
using signals::Edge;
using signals::Tick;

// --- view of all boards ---

MachineState::MachineState(const Boards& boards) noexcept
    : phase(boards.phase()), boards_(&boards) {}

const control::JointState& MachineState::joint(std::size_t joint) const noexcept {
  const Boards::Place at = boards_->joint_[joint];
  return boards_->boards_[at.board].state().joint[at.number];
}

const signals::Reading& MachineState::reading(std::size_t sensor) const noexcept {
  const Boards::Place at = boards_->sensor_[sensor];
  return boards_->boards_[at.board].state().reading[at.number];
}

const control::SensorStatistics& MachineState::supervised(std::size_t sensor) const noexcept {
  const Boards::Place at = boards_->sensor_[sensor];
  return boards_->boards_[at.board].supervised().sensor[at.number];
}

std::uint32_t MachineState::overruns() const noexcept {
  std::uint32_t sum = 0;
  for (const Board& b : boards_->boards_) sum += b.state().overruns;
  return sum;
}

std::uint32_t MachineState::rejected_commands() const noexcept {
  std::uint32_t sum = 0;
  for (const Board& b : boards_->boards_) sum += b.supervised().rejected_commands;
  return sum;
}

std::uint32_t MachineState::gaps() const noexcept {
  std::uint32_t most = 0;
  for (const Board& b : boards_->boards_) most = std::max(most, b.supervised().gaps);
  return most;
}

bool MachineState::tripped() const noexcept {
  return std::ranges::any_of(boards_->boards_, [](const Board& b) {
    return b.supervised().trip.cause != control::Trip::Cause::none;
  });
}

// --- the boards ---

Boards::Boards(std::span<const control::Board> boards) {
  for (const control::Board& board : boards) {
    const auto b = static_cast<std::uint8_t>(boards_.size());
    const Board& added = boards_.emplace_back(board.joint_controller, board.limits, board.joint,
                                              board.channel, board.valve);
    for (std::size_t i = 0; i < board.joint.size(); ++i)
      joint_[board.joint[i]] = {b, static_cast<std::uint8_t>(i)};
    for (std::size_t i = 0; i < board.channel.size(); ++i) {
      if (sensor_.size() <= board.channel[i]) sensor_.resize(board.channel[i] + 1u);
      sensor_[board.channel[i]] = {b, static_cast<std::uint8_t>(i)};
    }
    conversion_.insert(conversion_.end(), added.conversions().begin(), added.conversions().end());
    period_ = board.joint_controller.period;
  }
  std::ranges::stable_sort(conversion_, {}, &Conversion::read);
}

void Boards::command(const MachineCommand& command) noexcept {
  for (Board& b : boards_) b.supervisor.command(b.own(command));
}

// A body must not be driven by a part of its boards, so the others follow the first one that ends.
void Boards::end_together(Tick t) noexcept {
  if (state_.ended_by >= 0) return;
  for (std::size_t b = 0; b < boards_.size(); ++b)
    if (boards_[b].supervisor.state().fault != signals::Status::ok) {
      state_.ended_by = static_cast<int>(b);
      break;
    }
  if (state_.ended_by < 0) return;
  for (Board& b : boards_) {
    const Phase phase = b.supervisor.state().phase;
    if (phase == Phase::startup || phase == Phase::running) b.supervisor.shut_down(t);
  }
}

Tick Boards::next_event(Tick t) noexcept {
  if (boards_.size() > 1) end_together(t);
  Tick next = boards_.front().supervisor.next_event(t);
  for (std::size_t b = 1; b < boards_.size(); ++b)
    next = std::min(next, boards_[b].supervisor.next_event(t));
  return next;
}

void Boards::show(const control::ControllerState& controller, const control::Supervised& supervised,
                  Ticks valid) noexcept {
  boards_.front().show({controller, supervised});
  valid_ticks_ = valid;
}

void Boards::show_end(signals::Status why) noexcept {
  Board::ReportedState last{boards_.front().state(), boards_.front().supervised()};
  last.controller.phase = Phase::off;
  if (last.controller.fault == signals::Status::ok) last.controller.fault = why;
  boards_.front().show(last);
}

void Boards::missed(Tick t) noexcept {
  for (Board& b : boards_) b.supervisor.missed(t);
}

void Boards::shut_down(Tick t) noexcept {
  for (Board& b : boards_) b.supervisor.shut_down(t);
}

ControllerTotals Boards::controller_totals() const {
  ControllerTotals out;
  out.phase = state().phase;
  out.overruns = state().overruns();
  for (const Board& b : boards_) {
    const control::ControllerState& its = b.state();
    out.late += its.late;
    out.invalid += its.invalid;
    out.missed = std::max(out.missed, its.missed);
  }
  const Board& ended = boards_[static_cast<std::size_t>(std::max(state_.ended_by, 0))];
  const control::ControllerState& its = ended.state();
  out.fault = its.fault;
  const std::size_t channel = its.fault_channel.index;
  if (channel < ended.channels().size()) out.fault_channel = {ended.channels()[channel]};
  return out;
}

SupervisedTotals Boards::supervised_totals() const {
  SupervisedTotals out;
  const MachineState now = state();
  for (std::size_t s = 0; s < sensor_.size(); ++s) out.sensor.push_back(now.supervised(s));
  out.rejected_commands = now.rejected_commands();
  out.gaps = now.gaps();
  for (const Board& b : boards_) {
    const control::Supervised& its = b.supervised();
    out.rejected += its.rejected;
    out.worst_gap = std::max(out.worst_gap, its.worst_gap);
  }
  const auto ended = static_cast<std::size_t>(std::max(state_.ended_by, 0));
  out.trip = boards_[ended].trip();
  out.board = static_cast<int>(ended) + 1;
  return out;
}

std::size_t Boards::state_size() const noexcept {
  return sizeof state_ + boards_.size() * sizeof(control::Supervisor);
}

void Boards::save(std::span<std::byte> out) const noexcept {
  std::memcpy(out.data(), &state_, sizeof state_);
  std::byte* to = out.data() + sizeof state_;
  for (const Board& b : boards_) {
    std::memcpy(to, &b.supervisor, sizeof b.supervisor);
    to += sizeof b.supervisor;
  }
}

void Boards::restore(std::span<const std::byte> saved) noexcept {
  std::memcpy(&state_, saved.data(), sizeof state_);
  const std::byte* from = saved.data() + sizeof state_;
  for (Board& b : boards_) {
    std::memcpy(&b.supervisor, from, sizeof b.supervisor);
    from += sizeof b.supervisor;
  }
}

}  // namespace sinew::run
