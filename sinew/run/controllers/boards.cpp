#include "sinew/run/controllers/boards.h"

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace sinew::run {

using control::Phase;
using signals::Conversion;
using signals::Edge;
using signals::Tick;

static_assert(std::is_trivially_copyable_v<control::Supervisor>);

// --- one board ---

Board::Board(const control::Board& board)
    : supervisor(board.spine, board.limits),
      joint_(board.joint),
      channel_(board.channel),
      valve_(board.valve) {
  for (std::size_t i = 0; i < board.spine.conversions; ++i) {
    Conversion c = board.spine.conversion[i];
    c.channel.index = channel_[c.channel.index];
    conversion_.push_back(c);
  }
}

std::span<const Edge> Board::edges(Tick t) noexcept {
  const std::span<const Edge> decided = supervisor.edges(t);
  for (std::size_t i = 0; i < decided.size(); ++i) {
    out_[i] = decided[i];
    out_[i].valve.index = valve_[decided[i].valve.index];
  }
  return {out_.data(), decided.size()};
}

const Conversion* Board::due(Tick t) noexcept {
  const Conversion* its = supervisor.due(t);
  return its ? &conversion_[static_cast<std::size_t>(its - supervisor.config().conversion.data())]
             : nullptr;
}

void Board::take(const Conversion& conversion, signals::Reading reading, Tick t) noexcept {
  const auto i = static_cast<std::size_t>(&conversion - conversion_.data());
  supervisor.take(supervisor.config().conversion[i], reading, t);
}

control::Trip Board::trip() const noexcept {
  control::Trip trip = supervised().trip;
  if (trip.channel.index < channel_.size()) trip.channel.index = channel_[trip.channel.index];
  if (trip.joint < joint_.size()) trip.joint = joint_[trip.joint];
  return trip;
}

// --- view of all boards ---

MachineSeen::MachineSeen(const Boards& boards) noexcept
    : phase(boards.boards_.front().seen().phase), boards_(&boards) {
  for (const Board& b : boards.boards_) phase = std::min(phase, b.seen().phase);
}

const control::JointSeen& MachineSeen::joint(std::size_t joint) const noexcept {
  const Boards::Place at = boards_->joint_[joint];
  return boards_->boards_[at.board].seen().joint[at.number];
}

const signals::Reading& MachineSeen::reading(std::size_t sensor) const noexcept {
  const Boards::Place at = boards_->sensor_[sensor];
  return boards_->boards_[at.board].seen().reading[at.number];
}

const control::SensorSeen& MachineSeen::supervised(std::size_t sensor) const noexcept {
  const Boards::Place at = boards_->sensor_[sensor];
  return boards_->boards_[at.board].supervised().sensor[at.number];
}

std::uint32_t MachineSeen::overruns() const noexcept {
  std::uint32_t sum = 0;
  for (const Board& b : boards_->boards_) sum += b.seen().overruns;
  return sum;
}

std::uint32_t MachineSeen::rejected_commands() const noexcept {
  std::uint32_t sum = 0;
  for (const Board& b : boards_->boards_) sum += b.supervised().rejected_commands;
  return sum;
}

std::uint32_t MachineSeen::gaps() const noexcept {
  std::uint32_t most = 0;
  for (const Board& b : boards_->boards_) most = std::max(most, b.supervised().gaps);
  return most;
}

bool MachineSeen::tripped() const noexcept {
  return std::ranges::any_of(boards_->boards_, [](const Board& b) {
    return b.supervised().trip.cause != control::Trip::Cause::none;
  });
}

// --- the boards ---

Boards::Boards(std::span<const control::Board> boards) {
  for (const control::Board& board : boards) {
    const auto b = static_cast<std::uint8_t>(boards_.size());
    const Board& added = boards_.emplace_back(board);
    for (std::size_t i = 0; i < board.joint.size(); ++i)
      joint_[board.joint[i]] = {b, static_cast<std::uint8_t>(i)};
    for (std::size_t i = 0; i < board.channel.size(); ++i) {
      if (sensor_.size() <= board.channel[i]) sensor_.resize(board.channel[i] + 1u);
      sensor_[board.channel[i]] = {b, static_cast<std::uint8_t>(i)};
    }
    conversion_.insert(conversion_.end(), added.conversions().begin(), added.conversions().end());
    period_ = board.spine.period;
  }
  std::ranges::stable_sort(conversion_, {}, &Conversion::read);
}

void Boards::command(const MachineCommand& command) noexcept {
  for (Board& b : boards_) {
    control::Command its;
    const std::span<const std::uint8_t> joints = b.joints();
    for (std::size_t j = 0; j < joints.size(); ++j) its.joint[j] = command[joints[j]];
    b.supervisor.command(its);
  }
}

// A body must not be driven by a part of its boards, so the others follow the first one that ends.
void Boards::end_together(Tick t) noexcept {
  if (state_.ended_by >= 0) return;
  for (std::size_t b = 0; b < boards_.size(); ++b)
    if (boards_[b].supervisor.seen().fault != signals::Status::ok) {
      state_.ended_by = static_cast<int>(b);
      break;
    }
  if (state_.ended_by < 0) return;
  for (Board& b : boards_) {
    const Phase phase = b.supervisor.seen().phase;
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

void Boards::show(const control::Seen& seen, const control::Supervised& supervised,
                  Ticks known) noexcept {
  boards_.front().show({seen, supervised});
  known_ = known;
}

void Boards::show_end(signals::Status why) noexcept {
  Board::Far last{boards_.front().seen(), boards_.front().supervised()};
  last.seen.phase = Phase::off;
  if (last.seen.fault == signals::Status::ok) last.seen.fault = why;
  boards_.front().show(last);
}

void Boards::missed(Tick t) noexcept {
  for (Board& b : boards_) b.supervisor.missed(t);
}

void Boards::shut_down(Tick t) noexcept {
  for (Board& b : boards_) b.supervisor.shut_down(t);
}

SeenTotals Boards::seen_totals() const {
  SeenTotals out;
  out.phase = seen().phase;
  for (const Board& b : boards_) {
    const control::Seen& its = b.seen();
    out.late += its.late;
    out.invalid += its.invalid;
    out.overruns += its.overruns;
    out.missed = std::max(out.missed, its.missed);
  }
  const Board& ended = boards_[static_cast<std::size_t>(std::max(state_.ended_by, 0))];
  const control::Seen& its = ended.seen();
  out.fault = its.fault;
  const std::size_t channel = its.fault_channel.index;
  if (channel < ended.channels().size()) out.fault_channel = {ended.channels()[channel]};
  return out;
}

SupervisedTotals Boards::supervised_totals() const {
  SupervisedTotals out;
  const MachineSeen now = seen();
  for (std::size_t s = 0; s < sensor_.size(); ++s) out.sensor.push_back(now.supervised(s));
  for (const Board& b : boards_) {
    const control::Supervised& its = b.supervised();
    out.rejected += its.rejected;
    out.rejected_commands += its.rejected_commands;
    out.gaps = std::max(out.gaps, its.gaps);
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
