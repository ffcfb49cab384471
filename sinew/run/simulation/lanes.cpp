#include "sinew/run/simulation/lanes.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "sinew/run/setup/planar_setup.h"
#include "sinew/run/simulation/clock.h"
#include "sinew/run/simulation/recorded_run.h"
#include "sinew/run/simulation/simulation.h"
#include "sinew/world/batch.h"

namespace sinew::run {

using experiment::Experiment;
using signals::Tick;

namespace {

// The instant up to which a machine's nodes can be committed before a tick is visited, because the
// first that the tick asks of the machine commits them. A later bound would have readings look from
// another node than run()'s.
class Bounds {
 public:
  explicit Bounds(const signals::Scan& scan) : period_(scan.period), lag_(scan.period, none) {
    for (const signals::Conversion& c : scan.conversions)
      if (c.read < scan.period)
        lag_[c.read] = std::max(lag_[c.read], static_cast<Tick>(c.read - c.start));
  }

  double before(Tick t, bool samples) const noexcept {
    const Tick of_period = t % period_, lag = lag_[static_cast<std::size_t>(of_period)];
    if (lag != none) return seconds(t - lag);
    if (of_period == 0 && !samples) return nothing;  // the high level's word alone, as a rule
    return before(seconds(t));                       // an edge at t: all before it
  }

  static constexpr double nothing = -std::numeric_limits<double>::max();

 private:
  static constexpr Tick none = -1;
  // The greatest number below one that is not negative.
  static double before(double x) {
    return x > 0 ? std::bit_cast<double>(std::bit_cast<std::int64_t>(x) - 1) : nothing;
  }
  static double seconds(Tick t) { return static_cast<double>(t) * signals::tick_seconds; }

  Tick period_;
  std::vector<Tick> lag_;  // of what is read at a tick of the period
};

// One experiment in its lane.
class Lane {
 public:
  Lane(const Experiment& e, const plant::LegLane& machine, bool recorded)
      : experiment(e),
        simulation_(e, machine),
        run_(simulation_, {.recorded = recorded}),
        bounds_(simulation_.controllers().scan()) {}

  // The tick at which it stands, once its nodes are there; answers how far they must be for the
  // next.
  double turn() noexcept {
    SimulatedClock clock;
    if (reached_) run_.advance(simulation_.next() + 1, clock);
    reached_ = true;
    const Tick t = simulation_.next();
    if (run_.ended() || t >= simulation_.last()) return plant::Batch::over;
    return bounds_.before(t, run_.samples(t));
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
  Bounds bounds_;
  bool reached_ = false;
};

void run_alone(const Lanes& lanes, const Experiment& e) {
  Outcome out;
  std::exception_ptr thrown;
  try {
    out = run(e, {.recorded = lanes.recorded});
  } catch (...) {
    thrown = std::current_exception();
  }
  lanes.done(e, std::move(out), thrown);
}

// A batch, and the runs in it.
class Group {
 public:
  Group(const Lanes& lanes, const plant::Setup& like)
      : lanes_(lanes),
        like_(like),
        batch_(lanes.most, like),
        running_(static_cast<std::size_t>(batch_.width())) {}

  bool takes(const plant::Setup& setup) const { return plant::Batch::alike(setup, like_); }

  // Into lane k, in place of what has ended there.
  void put(int k, const Experiment& e, const plant::Setup& setup) {
    std::exception_ptr thrown;
    try {
      batch_.replace(k, setup);
      running_[static_cast<std::size_t>(k)] =
          std::make_unique<Lane>(e, plant::LegLane(batch_, k), lanes_.recorded);
      return;
    } catch (...) {
      thrown = std::current_exception();
    }
    lanes_.done(e, {}, thrown);
  }

  // Runs on until one has ended, tells of it, and answers its lane; -1 where none is left.
  int go() {
    auto turn = [this](int k) noexcept { return running_[static_cast<std::size_t>(k)]->turn(); };
    const int k = batch_.go(turn);
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

// The next experiment that the group can take goes into lane k; those that it cannot are run by
// themselves. False where there is none.
bool fill(const Lanes& lanes, std::optional<Group>& group, int k) {
  while (const Experiment* e = lanes.next()) {
    const plant::Setup setup = e->stand ? plant::Setup{} : planar_setup(*e);
    if (e->stand || !plant::Batch::holds(setup) || (group && !group->takes(setup))) {
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

// Two lanes alone are no faster than one world.
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
