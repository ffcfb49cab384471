#include "sinew/run/simulation/valve_commands.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "sinew/config/diagnostics.h"
#include "sinew/control/joint/pulse_train.h"
#include "sinew/control/setup/boards.h"
#include "sinew/robot/legs.h"
#include "sinew/run/controllers/columns.h"
#include "sinew/run/setup/installation.h"

namespace sinew::run {
namespace {

using signals::Edge;
using signals::Tick;

Tick tick_at(std::int64_t time_ns) {
  return (time_ns + signals::tick_nanoseconds / 2) / signals::tick_nanoseconds;
}

// Adds the edges of a series. A set point is a share of the regulator's range; for a valve, 1 opens
// and 0 shuts.
void add_edges(const signals::Series& series, std::uint8_t valve, std::vector<Edge>& out) {
  const bool level = series.topic.name.ends_with("/set_point");
  for (std::size_t i = 0; i < series.time_ns.size(); ++i) {
    const double value = series.columns[0][i];
    Edge edge{.at = tick_at(series.time_ns[i]), .valve = {valve}, .open = value > 0};
    if (level)
      edge.level =
          static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0, 1.0) * signals::max_level));
    out.push_back(edge);
  }
}

// A valve and the law that switches it.
struct Switched {
  const control::JointControllerConfig* board = nullptr;
  Tick law = 0;        // [ticks] within the period
  bool vents = false;  // whether it is an exhaust, which is open at the start
};

// Returns them by the machine's valves. A muscle that two joints share is driven by the later law.
std::vector<Switched> switched_valves(const std::vector<control::Board>& boards,
                                      std::size_t valves) {
  std::vector<Switched> out(valves);
  for (const control::Board& board : boards)
    for (std::size_t j = 0; j < board.joint_controller.joints; ++j) {
      const control::JointConfig& joint = board.joint_controller.joint[j];
      for (const control::MuscleConfig* muscle : {&joint.flexor, &joint.extensor}) {
        if (!muscle->present || joint.kind == control::JointKind::passive) continue;
        const auto set = [&](signals::Valve valve, bool exhaust) {
          Switched& its = out[board.valve[valve.index]];
          const bool later = its.board == nullptr || joint.law_tick >= its.law;
          if (later) its = {&board.joint_controller, joint.law_tick, exhaust};
        };
        set(muscle->inlet, false);
        if (joint.kind != control::JointKind::three_way) set(muscle->exhaust, true);
      }
    }
  return out;
}

// Moves edges before `until` from the train to the list.
void drive_until(control::PulseTrain& train, Tick until, std::uint8_t valve,
                 std::vector<Edge>& out) {
  while (train.next() < until) {
    out.push_back({.at = train.next(), .valve = {valve}, .open = train.next_opens()});
    train.drive();
  }
}

// Converts a valve's duty in each period into edges.
void rebuild(const signals::Series& duties, const Switched& its, std::uint8_t valve,
             std::vector<Edge>& out) {
  const control::JointControllerConfig& board = *its.board;
  control::PulseTrain train;
  if (its.vents && board.startup_vent > 0) train.pulse(0, board.startup_vent);
  const Tick periods = tick_at(duties.time_ns.back()) / board.period + 1;
  std::size_t next = 0;
  int duty = 0;
  for (Tick p = 0; p < periods; ++p) {
    const Tick end = (p + 1) * board.period;
    for (; next < duties.time_ns.size() && tick_at(duties.time_ns[next]) < end; ++next) {
      const double value = duties.columns[0][next];
      if (std::isfinite(value))
        duty = static_cast<int>(std::lround(100 * std::clamp(value, 0.0, 1.0)));
    }
    const Tick law = p * board.period + its.law;
    drive_until(train, law, valve, out);
    if (law < board.startup_vent) continue;
    const auto d = static_cast<std::size_t>(duty);
    train.cycle(
        law, {board.timing.closing[d], board.timing.opening[d], board.period, board.output_delay},
        true);
  }
  drive_until(train, periods * board.period, valve, out);
}

[[noreturn]] void refuse(const std::string& name, const std::vector<std::string>& missing) {
  config::fail({name, 0, 0}, "", fmt::format("no {}", fmt::join(missing, ", no ")),
               "the edges of every valve, or its duty in each period",
               "a mapping that names their columns, as sinew import makes it");
}

Tick end_of(const signals::Table& recorded) {
  std::int64_t end = 0;
  for (const signals::Series& s : recorded.series)
    if (!s.time_ns.empty()) end = std::max(end, s.time_ns.back());
  return tick_at(end) + 1;
}

}  // namespace

std::vector<std::string> edge_topics(const experiment::Experiment& e) {
  std::vector<std::string> out;
  for (signals::Topic& topic : topics(e))
    if (signals::is_of_valve(topic.name)) out.push_back(std::move(topic.name));
  return out;
}

std::vector<std::string> duty_topics(const experiment::Experiment& e) {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < e.robot.muscles.size(); ++i)
    for (const char* which : {"/inlet_duty", "/exhaust_duty"})
      out.push_back(robot::topic_of_muscle(e.robot, i) + which);
  for (const char* chamber : {"/cylinder/up", "/cylinder/down"})
    for (const char* which : {"/inlet_duty", "/exhaust_duty"})
      out.push_back(std::string(chamber) + which);
  return out;
}

ValveCommands valve_commands(const experiment::Experiment& e, const signals::Table& recorded,
                             const std::string& name) {
  const std::vector<std::string> edges = edge_topics(e), duties = duty_topics(e);
  const std::vector<control::Board> boards = boards_of(e);
  const std::vector<Switched> valves = switched_valves(boards, duties.size());
  ValveCommands out{.end = end_of(recorded)};
  std::vector<std::string> missing;
  for (std::size_t v = 0; v < edges.size(); ++v) {
    const auto valve = static_cast<std::uint8_t>(v);
    const signals::Series* duty = recorded.find(duties[v]);
    if (const signals::Series* series = recorded.find(edges[v])) {
      add_edges(*series, valve, out.edges);
    } else if (!valves[v].board) {
      continue;  // it is never switched, as the exhaust of a 3-way valve
    } else if (duty && !duty->time_ns.empty()) {
      rebuild(*duty, valves[v], valve, out.edges);
      out.rebuilt.push_back(duties[v]);
    } else {
      missing.push_back(fmt::format("{} or {}", edges[v], duties[v]));
    }
  }
  if (!missing.empty()) refuse(name, missing);
  std::ranges::stable_sort(out.edges, {}, &Edge::at);
  return out;
}

}  // namespace sinew::run
