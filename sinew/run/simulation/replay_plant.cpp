#include "sinew/run/simulation/replay_plant.h"

#include <algorithm>

#include "sinew/port/recorded/recorded.h"
#include "sinew/run/setup/machine_setup.h"
#include "sinew/run/simulation/clock.h"
#include "sinew/run/simulation/faulty_port.h"
#include "sinew/run/simulation/loop.h"
#include "sinew/run/simulation/recorded_run.h"
#include "sinew/world/machine.h"

namespace sinew::run {
namespace {

using signals::Tick;

// Brings the machine up to date with every edge before a sample is taken.
struct DrivenWatch {
  Watch watch;
  plant::Driven* driven;

  void command(Tick t) noexcept { watch.command(t); }
  void edge(const signals::Edge&) noexcept {}  // edges of a controller have no effect
  void sample(Tick t) noexcept {
    driven->catch_up(t);
    watch.sample(t);
  }
  Tick next(Tick t) const noexcept { return watch.next(t); }
};

signals::Series* find(signals::Table& table, const std::string& topic) {
  const auto at =
      std::ranges::find(table.series, topic, [](const auto& s) { return s.topic.name; });
  return at == table.series.end() ? nullptr : &*at;
}

// Replaces the controllers' own commands, which would be misleading, by those of the recording.
void put_commands(const experiment::Experiment& e, const ValveCommands& commands,
                  const signals::Table& recorded, signals::Table& out) {
  const std::vector<std::string> edges = edge_topics(e);
  std::vector<signals::Series*> of_valve;
  for (const std::string& topic : edges) {
    signals::Series* series = find(out, topic);
    series->time_ns.clear();
    series->columns[0].clear();
    of_valve.push_back(series);
  }
  for (const signals::Edge& edge : commands.edges) {
    signals::Series& series = *of_valve[edge.valve.index];
    const bool level = series.topic.name.ends_with("/set_point");
    series.time_ns.push_back(edge.at * signals::tick_nanoseconds);
    series.columns[0].push_back(level       ? static_cast<double>(edge.level) / signals::max_level
                                : edge.open ? 1.0
                                            : 0.0);
  }
  for (const std::string& topic : duty_topics(e)) {
    signals::Series* series = find(out, topic);
    if (!series) continue;
    if (const signals::Series* its = recorded.find(topic)) {
      series->time_ns = its->time_ns;
      series->columns = its->columns;
    } else {
      series->time_ns.clear();
      series->columns[0].clear();
    }
  }
}

}  // namespace

PlantReplay replay_plant(const experiment::Experiment& e, const signals::Table& recorded,
                         const std::string& name) {
  const ValveCommands commands = valve_commands(e, recorded, name);
  plant::Machine machine(planar_setup(e));
  plant::Driven driven(machine.port(), commands.edges);
  std::optional<FaultyPort> faulty;
  signals::Port& body =
      e.faults.empty() ? static_cast<signals::Port&>(driven) : faulty.emplace(e, driven);
  Controllers controllers(e, nullptr);
  const Tick end = std::min(experiment::last_tick(e), commands.end);
  Recorder recorder(e, columns(e), controllers, &machine, end);

  PlantReplay out{.rebuilt = commands.rebuilt};
  DrivenWatch watch{{&recorder, &machine}, &driven};
  SimulatedClock clock;
  out.outcome.status = controllers.visit(
      [&](auto& level) { return loop(controllers.boards(), level, body, clock, watch, end); });
  out.outcome.failure = machine.failure();
  out.outcome.controller = controllers.boards().controller_totals();
  out.outcome.supervised = controllers.boards().supervised_totals();
  out.outcome.nodes = machine.nodes();
  out.outcome.table = recorder.take();
  out.outcome.no_room = recorder.problem();
  out.outcome.duration = static_cast<double>(end) * signals::tick_seconds;
  put_commands(e, commands, recorded, out.outcome.table);
  return out;
}

}  // namespace sinew::run
