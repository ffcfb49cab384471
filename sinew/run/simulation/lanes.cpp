#include "sinew/run/simulation/lanes.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "sinew/run/setup/machine_setup.h"
#include "sinew/run/simulation/clock.h"
#include "sinew/run/simulation/node_bounds.h"
#include "sinew/run/simulation/recorded_run.h"
#include "sinew/run/simulation/simulation.h"
#include "sinew/world/batch.h"

namespace sinew::run {

using experiment::Experiment;
using signals::Tick;

namespace {

RunOptions options_of(const Lanes& lanes, const Experiment& e) {
  return {.recorded = lanes.recorded, .topics = lanes.topics ? lanes.topics(e) : nullptr};
}

// An experiment in its lane.
class Lane {
 public:
  Lane(const Experiment& e, const plant::LegLane& machine, const RunOptions& options)
      : experiment(e), simulation_(e, machine), run_(simulation_, options) {}

  // Visits the present tick, whose nodes are committed; returns the time to which they must be
  // committed for the next one.
  double turn() noexcept {
    SimulatedClock clock;
    if (reached_) run_.advance(simulation_.next() + 1, clock);
    reached_ = true;
    const Tick t = simulation_.next();
    if (run_.ended() || t >= simulation_.last()) return plant::Batch::finished;
    const Controllers& controllers = simulation_.controllers();
    return bounds_.before(controllers.scan(), t, run_.samples(t),
                          controllers.boards().drives_at(t));
  }

  Outcome finish() {
    SimulatedClock clock;
    run_.advance(simulation_.last(), clock);
    Outcome out = run_.finish();
    out.nodes = simulation_.machine()->nodes();
    return out;
  }

  const Experiment& experiment;

 private:
  Simulation simulation_;
  RecordedRun run_;
  NodeBounds bounds_;
  bool reached_ = false;
};

void run_alone(const Lanes& lanes, const Experiment& e) {
  Outcome out;
  std::exception_ptr thrown;
  try {
    out = run(e, options_of(lanes, e));
  } catch (...) {
    thrown = std::current_exception();
  }
  lanes.done(e, std::move(out), thrown);
}

// A batch and its runs.
class Group {
 public:
  Group(const Lanes& lanes, const plant::Setup& like)
      : lanes_(lanes),
        like_(like),
        batch_(lanes.most, like),
        running_(static_cast<std::size_t>(batch_.width())) {}

  bool takes(const plant::Setup& setup) const { return plant::Batch::alike(setup, like_); }

  // Puts an experiment into lane k, replacing one that has ended.
  void put(int k, const Experiment& e, const plant::Setup& setup) {
    std::exception_ptr thrown;
    try {
      batch_.replace(k, setup);
      running_[static_cast<std::size_t>(k)] =
          std::make_unique<Lane>(e, plant::LegLane(batch_, k), options_of(lanes_, e));
      return;
    } catch (...) {
      thrown = std::current_exception();
    }
    lanes_.done(e, {}, thrown);
  }

  // Continues until a run has ended, reports it, and returns its lane; -1 if no run is left.
  int go() {
    auto turn = [this](int k) noexcept { return running_[static_cast<std::size_t>(k)]->turn(); };
    const int k = batch_.run(turn);
    if (k < 0) return k;
    const std::unique_ptr<Lane> ended = std::move(running_[static_cast<std::size_t>(k)]);
    lanes_.done(ended->experiment, ended->finish(), nullptr);
    return k;
  }

  int width() const { return batch_.width(); }
  bool empty(int k) const { return !running_[static_cast<std::size_t>(k)]; }

 private:
  const Lanes& lanes_;
  plant::Setup like_;
  plant::Batch batch_;
  std::vector<std::unique_ptr<Lane>> running_;
};

// Puts the next experiment that the group can take into lane k; runs the others by themselves.
// Returns false if there are no more experiments.
bool fill(const Lanes& lanes, std::optional<Group>& group, int k) {
  while (const Experiment* e = lanes.next()) {
    const plant::Setup setup = e->stand ? plant::Setup{} : planar_setup(*e);
    if (e->stand || !plant::Batch::fits(setup) || (group && !group->takes(setup))) {
      run_alone(lanes, *e);
      continue;
    }
    if (!group) group.emplace(lanes, setup);
    group->put(k, *e, setup);
    if (!group->empty(k)) return true;
  }
  return false;
}

}  // namespace

// Two lanes are no faster than one run after the other.
int widest_lanes() { return plant::Batch::widest() > 2 ? plant::Batch::widest() : 1; }

void run_in_lanes(const Lanes& lanes) {
  if (lanes.most < 2 || (lanes.most > 2 && widest_lanes() == 1)) {
    while (const Experiment* e = lanes.next()) run_alone(lanes, *e);
    return;
  }
  std::optional<Group> group;
  bool more = fill(lanes, group, 0);
  if (!group) return;
  for (int k = 1; more && k < group->width(); ++k) more = fill(lanes, group, k);
  for (int k = group->go(); k >= 0; k = group->go())
    if (more) more = fill(lanes, group, k);
}

}  // namespace sinew::run
