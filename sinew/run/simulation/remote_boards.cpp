#include "sinew/run/simulation/remote_boards.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "sinew/control/link/texts.h"
#include "sinew/run/setup/installation.h"
#include "sinew/units/constants.h"

namespace sinew::run {

using signals::Edge;
using signals::Status;
using signals::Tick;

namespace {

// Time without a message after which the host gives a board up [s]; the board has vented itself by
// then (docs/reference/supervision.md).
constexpr double silence = 1.5;
// Number of periods for which a command is valid: a frame may be lost, and the next one as well.
constexpr std::uint8_t good_for = 3;
// Largest plausible distance of a reported edge ahead of the present tick: ten minutes. Later edges
// are transmission errors.
constexpr Tick farthest = 10 * 60 * 10'000;

}  // namespace

control::Board only_board(const experiment::Experiment& e) {
  const std::vector<control::Board> boards = boards_of(e);
  if (boards.size() != 1)
    throw std::invalid_argument(fmt::format(
        "the robot is driven by {} boards; expected one: a line leads to one board, and the clocks "
        "of several are not joined yet",
        boards.size()));
  return boards.front();
}

link::Configuration configuration_of(const experiment::Experiment& e) {
  const control::Board board = only_board(e);
  link::Configuration out{board.joint_controller, board.limits, {}};
  out.safety.host_hold =
      std::max<std::uint32_t>(out.safety.host_hold, 3u * board.joint_controller.period);
  out.safety.host_vent = std::max(out.safety.host_vent, out.safety.host_hold);
  return out;
}

namespace {

using Kind = robot::Sensor::Kind;

// Pressure at which a muscle counts as empty, since less moves no joint.
constexpr double empty_pressure = 2 * units::psi;  // gauge
constexpr double noise_bound = 6;                  // standard deviations, robot/sensing.h

// Returns the count up to which a gauge shows an empty muscle, by its real or its assumed scale; 0
// if it cannot, because the count is beyond the converter's range.
std::uint16_t empty_count(const robot::Sensor& s, const robot::Converter& converter) {
  const double pascal = converter.counts_per_volt() * empty_pressure;
  const double most =
      std::max(s.at_rest + pascal * s.scale, s.assumed_at_rest + pascal * s.assumed_scale);
  const double count = std::ceil(most + noise_bound * s.noise);
  return count >= 1 && count < converter.top() ? static_cast<std::uint16_t>(count) : 0;
}

std::uint16_t empty_count(const robot::Transducer& t) {
  robot::Transducer assumed = t;
  assumed.scale = 1;
  assumed.offset = 0;
  const std::uint16_t count = std::max(robot::counts(t, empty_pressure, noise_bound),
                                       robot::counts(assumed, empty_pressure, noise_bound));
  return count < signals::max_counts ? count : 0;
}

// Returns whether valves fill a muscle and empty it. The pressure that a regulator holds is no
// residue.
bool has_valves(const experiment::Experiment& e, const control::Board& board,
                const std::string& muscle) {
  const int m = robot::find_muscle(e.robot, muscle);
  if (m < 0) return false;
  const int j = robot::find_joint(e.robot, e.robot.muscles[static_cast<std::size_t>(m)].joint);
  const auto at = std::ranges::find(board.joint, j);
  if (at == board.joint.end()) return false;
  const auto kind =
      board.joint_controller.joint[static_cast<std::size_t>(at - board.joint.begin())].kind;
  return kind == control::JointKind::antagonist || kind == control::JointKind::three_way;
}

void watch_pressures(const experiment::Experiment& e, control::SafetyConfig& out) {
  const control::Board board = only_board(e);
  for (std::size_t i = 0; i < board.channel.size() && i < out.empty_at.size(); ++i) {
    if (e.stand) {
      const robot::Transducer& t = e.stand->sensors[board.channel[i]];
      if (t.of == robot::Transducer::Of::pressure && !board.valve.empty())
        out.empty_at[i] = empty_count(t);
      continue;
    }
    const robot::Sensor& s = e.robot.sensors[board.channel[i]];
    if (s.kind == Kind::pressure && has_valves(e, board, s.of))
      out.empty_at[i] = empty_count(s, e.robot.converter);
  }
}

}  // namespace

link::Configuration bench_configuration_of(const experiment::Experiment& e) {
  constexpr std::uint32_t most_missing = 3;
  link::Configuration out = configuration_of(e);
  if (out.joint_controller.hold_limit == 0) out.joint_controller.hold_limit = most_missing;
  watch_pressures(e, out.safety);
  out.safety.vent_limit = std::max(out.safety.vent_limit, 2 * out.joint_controller.shutdown_vent);
  return out;
}

RemoteBoards::RemoteBoards(Boards& shown, plant::RemoteBoard& board, int lead)
    : shown_(&shown), board_(&board), period_(shown.scan().period), lead_(lead), views_{{{this}}} {
  const Board& its = shown.each().front();
  joint_.assign(its.joints().begin(), its.joints().end());
  valve_.assign(its.valves().begin(), its.valves().end());
  const auto conversions = shown.scan().conversions;
  if (!conversions.empty()) last_read_ = conversions.back().read;
  edges_.reserve(4'096);
}

void RemoteBoards::command(const MachineCommand& command) noexcept { command_ = command; }

// A law continues with its last command, so that period 0 has the plan's first one. Openings are
// valid for one period: if commands are sent ahead, period 0 has no openings, and all others are
// delayed by the lead.
bool RemoteBoards::send(Tick t) noexcept {
  if (end_sent_) return true;
  link::CommandFor out{.from = t == 0 ? 0 : t + lead_ * period_,
                       .periods = good_for,
                       .ends = ends_ && t > 0,
                       .joints = static_cast<std::uint8_t>(joint_.size())};
  for (std::size_t j = 0; j < joint_.size(); ++j) out.joint[j] = command_[joint_[j]];
  end_sent_ = out.ends;
  if (t == 0 && lead_ > 0 && std::ranges::any_of(out.joint, &control::JointCommand::timed)) {
    link::CommandFor first = out;
    for (control::JointCommand& c : first.joint)
      if (c.timed) c.openings = {};
    if (!board_->command(first)) return false;
    out.from = lead_ * period_;
  }
  return board_->command(out);
}

Tick RemoteBoards::next_event(Tick t) noexcept {
  if (t < next_) return next_;
  edges_.clear();
  if (over_) {
    shown_->show_end(board_->why() == plant::RemoteBoard::Why::over ? Status::ok : Status::fault);
    return t + 1;
  }
  const double until = board_->now() + silence;
  const link::Telemetry* telemetry = send(t) ? board_->next(silence) : nullptr;
  while (telemetry != nullptr && (telemetry->tick <= t || telemetry->tick > t + farthest)) {
    if (telemetry->tick > t) ++foreign_;
    telemetry = board_->next(until - board_->now());
  }
  take_edges(t);
  handed_on_ = false;
  if (telemetry == nullptr) {
    over_ = true;  // except for the edges that came with it
    return t + 1;
  }
  lost_ += static_cast<std::uint32_t>((telemetry->tick - t) / period_) - 1;
  next_ = telemetry->tick;
  // Nothing is converted at the tick at which a period begins.
  shown_->show(telemetry->controller, telemetry->supervised,
               {next_ - period_ + last_read_, next_ + 1});
  return next_;
}

// Stores reported edges in the machine's numbering; discards those with a valve or a time that the
// board cannot have.
void RemoteBoards::take_edges(Tick t) noexcept {
  for (Edge edge : board_->edges()) {
    if (edge.valve.index >= valve_.size() || edge.at < 0 || edge.at > t + farthest) {
      ++foreign_;
      continue;
    }
    edge.valve.index = valve_[edge.valve.index];
    if (edges_.size() < edges_.capacity()) edges_.push_back(edge);
  }
}

// Returns each edge once, at the next tick that the loop visits.
std::span<const Edge> RemoteBoards::edges() noexcept {
  if (handed_on_) return {};
  handed_on_ = true;
  return edges_;
}

std::span<const Edge> RemoteBoards::last_edges(Tick end) noexcept {
  std::erase_if(edges_, [&](const Edge& edge) { return edge.at >= end; });
  return edges();
}

Status RemoteBoards::stop(Tick) noexcept {
  return board_->shut_down() ? Status::ok : Status::fault;
}

std::string RemoteBoards::problem() const {
  using Why = plant::RemoteBoard::Why;
  if (board_->why() == Why::silent) return fmt::format("the board was not heard for {} s", silence);
  if (board_->why() == Why::closed) return "the line to the board is gone";
  if (board_->state() == control::BoardState::dump)
    return fmt::format("the board is in dump: {}", link::to_text(board_->fault()));
  const bool explained = end_sent_ || shown_->controller_totals().fault != Status::ok ||
                         shown_->supervised_totals().trip.cause != control::Trip::Cause::none;
  if (board_->why() == Why::over && !explained)
    return fmt::format("the board has left the run: {}", link::to_text(board_->fault()));
  return "";
}

namespace {

const char* name(control::BoardState state) {
  constexpr const char* names[] = {"fault", "idle", "armed", "running", "hold", "vent", "dump"};
  return names[static_cast<std::size_t>(state)];
}

std::string head(const control::Board& board, const robot::Robot& robot) {
  std::string out = "time_s,state,why,frames";
  for (const std::uint8_t sensor : board.channel) {
    const std::string& name = robot.sensors[sensor].name;
    out += fmt::format(",{0}.reading,{0}.counts,{0}.rejected", name);
  }
  for (const std::uint8_t joint : board.joint) {
    const std::string name =
        joint < robot.joints.size() ? robot.joints[joint].name : std::string("cylinder");
    for (const char* field : {"velocity", "stiffness_output", "angle_output", "flexor_inlet",
                              "flexor_exhaust", "extensor_inlet", "extensor_exhaust"})
      out += fmt::format(",{}.{}", name, field);
  }
  return out + "\n";
}

std::string line(const link::Telemetry& t, const control::Board& board) {
  std::string out;
  const auto to = std::back_inserter(out);
  fmt::format_to(to, "{:.4f},{},\"{}\",{}", signals::tick_seconds * static_cast<double>(t.tick),
                 name(t.state), link::to_text(t.fault), t.link.line.frames);
  for (std::size_t c = 0; c < board.channel.size(); ++c) {
    const control::SensorStatistics& sensor = t.supervised.sensor[c];
    fmt::format_to(to, ",{},{},{}", t.controller.reading[c].counts, sensor.counts, sensor.rejected);
  }
  for (std::size_t j = 0; j < board.joint.size(); ++j) {
    const control::JointState& joint = t.controller.joint[j];
    const control::Duties& d = joint.duties;
    fmt::format_to(to, ",{},{},{},{},{},{},{}", joint.velocity, joint.stiffness_output,
                   joint.angle_output, d.flexor_inlet, d.flexor_exhaust, d.extensor_inlet,
                   d.extensor_exhaust);
  }
  return out + "\n";
}

}  // namespace

std::string fault_log_csv(std::span<const link::Telemetry> log, const experiment::Experiment& e) {
  const control::Board board = only_board(e);
  std::string out = head(board, named_parts(e));
  for (const link::Telemetry& t : log) out += line(t, board);
  return out;
}

}  // namespace sinew::run
