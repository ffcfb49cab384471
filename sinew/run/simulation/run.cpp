#include "sinew/run/simulation/run.h"

#include <chrono>
#include <limits>

#include "sinew/plant/recorded/recorded.h"
#include "sinew/run/simulation/clock.h"
#include "sinew/run/simulation/simulation.h"

namespace sinew::run {

using signals::Tick;

namespace {

// The recorder, and on demand more looks and more visits than a run needs, which change nothing.
struct Watch {
  Recorder& recorder;
  plant::Machine* machine;  // none where a log is replayed
  bool every_tick;
  int extra_readers;
  const std::atomic<bool>* stop;
  bool was_stopped = false;

  bool stopped() noexcept {
    was_stopped = was_stopped || (stop && stop->load(std::memory_order_relaxed));
    return was_stopped;
  }
  void command(Tick t) noexcept { recorder.command(t); }
  void edge(const signals::Edge& e) noexcept {
    if (!failed()) recorder.edge(e);
  }
  void sample(Tick t) noexcept {
    // Nothing is recorded of a machine that has failed.
    if (machine && t >= recorder.next(t))
      machine->advance(static_cast<double>(t) * signals::tick_seconds);
    if (failed()) return;
    for (int i = 0; i < extra_readers; ++i)
      if (machine) (void)machine->truth(static_cast<double>(t) * signals::tick_seconds);
    recorder.sample(t);
  }
  Tick next(Tick t) const noexcept {
    if (failed()) return std::numeric_limits<Tick>::max();
    return every_tick ? t + 1 : recorder.next(t);
  }
  bool failed() const noexcept { return machine && machine->failure(); }
};

// From where the simulation stands to its end, recorded.
template <class Clock>
Outcome to_the_end(Simulation& simulation, const RunOptions& options, Clock& clock) {
  plant::Machine* machine = simulation.machine();
  Recorder::TruthAt truth;
  if (machine)
    truth = [machine](Tick t) {
      return machine->truth(static_cast<double>(t) * signals::tick_seconds);
    };
  Recorder recorder(simulation.experiment(), simulation.boards(), simulation.high_level(), truth,
                    simulation.last());
  if (options.tap.push) recorder.tap(options.tap, options.tapped);
  recorder.progress(options.progress);
  Watch watch{recorder, machine, options.every_tick, options.extra_readers, options.stop};

  const auto before = std::chrono::steady_clock::now();
  simulation.advance(simulation.last(), clock, watch);
  Outcome out;
  out.status = simulation.finish();
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - before;

  out.wall = wall.count();
  out.stopped = watch.was_stopped;
  out.failure = simulation.failure();
  out.table = recorder.take();
  out.no_room = recorder.problem();
  out.seen = simulation.boards().seen_totals();
  out.supervised = simulation.boards().supervised_totals();
  out.changes = simulation.high_level().changes().all();
  out.unreachable_periods = simulation.high_level().legs().unreachable_periods();
  out.duration = static_cast<double>(simulation.last()) * signals::tick_seconds;
  for (const signals::Series& s : out.table.series)
    if (!s.time_ns.empty() && s.topic.name.ends_with("/plan/phase"))
      out.duration = 1e-9 * static_cast<double>(s.time_ns.back());
  return out;
}

}  // namespace

Outcome run(const experiment::Experiment& e, const RunOptions& options) {
  Simulation simulation(e, options.steering);
  if (options.steering) {
    SteeredClock clock(*options.steering, 0.01 + e.log.period);
    return to_the_end(simulation, options, clock);
  }
  if (options.pace > 0) {
    PacedClock clock(options.pace);
    return to_the_end(simulation, options, clock);
  }
  SimulatedClock clock;
  Outcome out = to_the_end(simulation, options, clock);
  out.nodes = simulation.machine()->nodes();
  return out;
}

Outcome replay(const experiment::Experiment& e, const signals::Table& recorded) {
  plant::Recorded port(e.robot, recorded);
  Simulation simulation(e, port);
  SimulatedClock clock;
  return to_the_end(simulation, {}, clock);
}

}  // namespace sinew::run
