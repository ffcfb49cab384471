#include "sinew/identify/machine/driven_run.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "sinew/run/setup/planar_setup.h"
#include "sinew/run/simulation/valve_commands.h"
#include "sinew/world/machine.h"

namespace sinew::identify {

using experiment::Experiment;

namespace {

// Do all edges stand at the rows of a table? It then knows them to one of its rows.
bool is_of_rows(const signals::Series& edges, const std::vector<RunChannel>& channels) {
  return std::ranges::all_of(edges.time_ns, [&](std::int64_t time) {
    const signals::Tick at = time / signals::tick_nanoseconds;
    return std::ranges::binary_search(channels[0].at, at);
  });
}

}  // namespace

DrivenRun::DrivenRun(const Experiment& e, const signals::Table& recorded, bool imported,
                     const std::string& name)
    : channels_(run_channels(e, recorded, imported, name)) {
  signals::Table table = recorded;
  const std::vector<std::string> edges = run::edge_topics(e), duties = run::duty_topics(e);
  for (std::size_t v = 0; v < edges.size(); ++v) {
    const signals::Series* series = recorded.find(edges[v]);
    if (!imported || !series || series->time_ns.empty() || !is_of_rows(*series, channels_))
      continue;
    if (recorded.find(duties[v]))  // which says when within the period it was
      std::erase_if(table.series, [&](const auto& s) { return s.topic.name == edges[v]; });
    else
      coarse_.push_back(edges[v]);
  }
  run::ValveCommands commands = run::valve_commands(e, table, name);
  edges_ = std::move(commands.edges);
  rebuilt_ = std::move(commands.rebuilt);
  for (std::size_t c = 0; c < channels_.size(); ++c)
    for (const signals::Tick at : channels_[c].at) {
      instants_.push_back({at, instants_.size(), c});
      time_.push_back(static_cast<double>(at) * signals::tick_seconds);
    }
  std::ranges::stable_sort(instants_, {}, &Instant::at);
}

double DrivenRun::duration() const {
  return static_cast<double>(instants_.back().at) * signals::tick_seconds;
}

template <class Visit>
bool DrivenRun::drive(const Experiment& e, double until, Visit visit) const {
  plant::Machine machine(run::planar_setup(e));
  std::size_t edge = 0;
  signals::Tick shown = -1;
  plant::Truth truth;
  for (const Instant& i : instants_) {
    const double t = static_cast<double>(i.at) * signals::tick_seconds;
    if (t > until) break;
    for (; edge < edges_.size() && edges_[edge].at <= i.at; ++edge)
      (void)machine.port().drive(edges_[edge]);
    // Several sensors may be sampled at once.
    if (i.at != shown) truth = machine.truth(t);
    shown = i.at;
    if (machine.failure() || !visit(i, truth)) return false;
  }
  return true;
}

bool DrivenRun::predict(const Experiment& e, std::span<double> out, double until) const {
  return drive(e, until, [&](const Instant& i, const plant::Truth& truth) {
    const RunChannel& c = channels_[i.channel];
    out[i.sample] = c.expected(c.quantity(truth, e.robot, e.air.atmosphere));
    return std::isfinite(out[i.sample]);
  });
}

int DrivenRun::landings(const Experiment& e, double until) const {
  std::array<bool, robot::max_legs> foot{};
  std::array<bool, robot::max_discs> disc{};
  int out = 0;
  bool first = true;
  const auto note = [&](bool& down, double force) {
    out += !first && force > 0 && !down ? 1 : 0;
    down = force > 0;
  };
  (void)drive(e, until, [&](const Instant&, const plant::Truth& truth) {
    for (std::size_t k = 0; k < foot.size(); ++k) note(foot[k], truth.foot[k].force_y);
    for (std::size_t k = 0; k < disc.size(); ++k) note(disc[k], truth.disc_force[k]);
    first = false;
    return true;
  });
  return out;
}

}  // namespace sinew::identify
