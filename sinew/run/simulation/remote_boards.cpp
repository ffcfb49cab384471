#include "sinew/run/simulation/remote_boards.h"

#include <fmt/format.h>

#include <stdexcept>

#include "sinew/control/link/words.h"
#include "sinew/run/setup/installation.h"

namespace sinew::run {

using signals::Edge;
using signals::Status;
using signals::Tick;

namespace {

// For how long a board may say nothing until the host gives it up; it has vented itself by then
// (docs/supervision.md).
constexpr double silence = 1.5;
// A frame may be lost, and the next one as well.
constexpr std::uint8_t good_for = 3;

}  // namespace

control::Board only_board(const experiment::Experiment& e) {
  const std::vector<control::Board> boards = control::boards(installation(e));
  if (boards.size() != 1)
    throw std::invalid_argument(fmt::format(
        "the robot is driven by {} boards; expected one: a line leads to one board, and the clocks "
        "of several are not joined yet",
        boards.size()));
  return boards.front();
}

link::Configuration configuration_of(const experiment::Experiment& e) {
  const control::Board board = only_board(e);
  return {board.spine, board.limits, {}};
}

RemoteBoards::RemoteBoards(Boards& shown, plant::RemoteBoard& board, int lead)
    : shown_(&shown), board_(&board), period_(shown.scan().period), lead_(lead), told_{{{this}}} {
  const Board& its = shown.each().front();
  joint_.assign(its.joints().begin(), its.joints().end());
  valve_.assign(its.valves().begin(), its.valves().end());
  const auto conversions = shown.scan().conversions;
  if (!conversions.empty()) last_read_ = conversions.back().read;
  edges_.reserve(4'096);
}

void RemoteBoards::command(const MachineCommand& command) noexcept { command_ = command; }

bool RemoteBoards::send(Tick t) noexcept {
  if (end_sent_) return true;
  link::CommandFor out{.from = t == 0 ? 0 : t + lead_ * period_,
                       .periods = good_for,
                       .ends = ends_ && t > 0,
                       .joints = static_cast<std::uint8_t>(joint_.size())};
  for (std::size_t j = 0; j < joint_.size(); ++j) out.joint[j] = command_[joint_[j]];
  end_sent_ = out.ends;
  return board_->command(out);
}

Tick RemoteBoards::next_event(Tick t) noexcept {
  if (t < next_) return next_;
  edges_.clear();
  if (over_) {
    shown_->show_end(board_->why() == plant::RemoteBoard::Why::over ? Status::ok : Status::fault);
    return t + 1;
  }
  const link::Telemetry* told = send(t) ? board_->next(silence) : nullptr;
  while (told != nullptr && told->tick <= t) told = board_->next(silence);
  for (Edge edge : board_->edges()) {
    edge.valve.index = valve_[edge.valve.index];
    if (edges_.size() < edges_.capacity()) edges_.push_back(edge);
  }
  handed_on_ = false;
  if (told == nullptr) {
    over_ = true;  // but for the edges that came with it
    return t + 1;
  }
  lost_ += static_cast<std::uint32_t>((told->tick - t) / period_) - 1;
  next_ = told->tick;
  shown_->show(told->seen, told->supervised, {next_ - period_ + last_read_, next_});
  return next_;
}

// An edge is recorded once, at the next tick that the loop visits.
std::span<const Edge> RemoteBoards::edges() noexcept {
  if (handed_on_) return {};
  handed_on_ = true;
  return edges_;
}

Status RemoteBoards::stop(Tick) noexcept {
  return board_->shut_down() ? Status::ok : Status::fault;
}

std::string RemoteBoards::problem() const {
  using Why = plant::RemoteBoard::Why;
  if (board_->why() == Why::silent) return fmt::format("the board was not heard for {} s", silence);
  if (board_->why() == Why::gone) return "the line to the board is gone";
  const bool explained =
      end_sent_ || shown_->supervised_totals().trip.cause != control::Trip::Cause::none;
  if (board_->why() == Why::over && !explained)
    return fmt::format("the board has left the run: {}", link::in_words(board_->fault()));
  return "";
}

}  // namespace sinew::run
