// run/simulation/recorded_run.h - a run in progress: the simulation with its recorder, advanced in
// steps of any size, and its outcome.
#pragma once

#include <atomic>
#include <chrono>
#include <limits>
#include <optional>

#include "sinew/run/simulation/recorder.h"
#include "sinew/run/simulation/run.h"
#include "sinew/run/simulation/simulation.h"

namespace sinew::run {

// The recorder; for tests also additional readings and visited ticks, which change nothing.
struct Watch {
  Recorder* recorder;       // nullptr: nothing is recorded
  plant::Machine* machine;  // nullptr if a log is replayed
  bool every_tick = false;
  int extra_readers = 0;
  const std::atomic<bool>* stop = nullptr;
  bool was_stopped = false;

  // Returns whether a stop was requested; the request is latched.
  bool stopped() noexcept {
    was_stopped = was_stopped || (stop && stop->load(std::memory_order_relaxed));
    return was_stopped;
  }
  // Called by the loop: a command, an edge, a sample's instant, and the next tick to be visited.
  void command(signals::Tick t) noexcept {
    if (recorder) recorder->command(t);
  }
  void edge(const signals::Edge& e) noexcept {
    if (recorder && !failed()) recorder->edge(e);
  }
  void sample(signals::Tick t) noexcept;
  signals::Tick next(signals::Tick t) const noexcept {
    if (every_tick && !failed()) return t + 1;
    return sample_at();
  }
  // Returns the next tick at which a sample is recorded.
  signals::Tick sample_at() const noexcept {
    return recorder && !failed() ? recorder->next(0) : std::numeric_limits<signals::Tick>::max();
  }
  bool failed() const noexcept { return machine && machine->failure(); }
};

// Adds what a recorder and the controllers show at the end of a run that may last to the tick
// `last`.
void add_end(const experiment::Experiment& experiment, const Controllers& controllers,
             Recorder* recorder, signals::Tick last, Outcome& out);

class RecordedRun {
 public:
  // Starts at the present state of the simulation, which must outlive this object.
  explicit RecordedRun(Simulation& simulation, const RunOptions& options = {});
  RecordedRun(const RecordedRun&) = delete;
  RecordedRun& operator=(const RecordedRun&) = delete;

  // Runs all that happens before the tick.
  template <class Clock>
  void advance(signals::Tick until, Clock& clock) noexcept {
    simulation_.advance(until, clock, watch_);
  }
  // Returns whether the run is over.
  bool ended() noexcept { return simulation_.ended() || watch_.stopped(); }
  // Returns whether a sample is due at the next tick.
  bool samples(signals::Tick t) const noexcept { return t >= watch_.sample_at(); }

  // Leaves the body safe and returns the outcome. To be called once.
  Outcome finish();

 private:
  Simulation& simulation_;
  std::optional<Recorder> recorder_;
  Watch watch_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace sinew::run
