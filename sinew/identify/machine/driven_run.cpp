#include "sinew/identify/machine/driven_run.h"

#include <algorithm>
#include <cmath>

#include "sinew/plant/machine/machine.h"
#include "sinew/run/setup/planar_setup.h"
#include "sinew/run/simulation/valve_commands.h"

namespace sinew::identify {

using experiment::Experiment;

DrivenRun::DrivenRun(const Experiment& e, const signals::Table& recorded, bool imported,
                     const std::string& name)
    : channels_(run_channels(e, recorded, imported, name)) {
  run::ValveCommands commands = run::valve_commands(e, recorded, name);
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

bool DrivenRun::predict(const Experiment& e, std::span<double> out, double until) const {
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
    const RunChannel& c = channels_[i.channel];
    const double value = c.expected(c.quantity(truth, e.robot, e.air.atmosphere));
    if (machine.failure() || !std::isfinite(value)) return false;
    out[i.sample] = value;
  }
  return true;
}

}  // namespace sinew::identify
