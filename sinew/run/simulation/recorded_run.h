// run/simulation/recorded_run.h - a run on its way: the simulation with its recorder, advanced by
// as much as one likes, and its outcome.
#pragma once

#include <atomic>
#include <chrono>
#include <limits>
#include <optional>

#include "sinew/run/simulation/recorder.h"
#include "sinew/run/simulation/run.h"
#include "sinew/run/simulation/simulation.h"

namespace sinew::run {

// The recorder, and on demand more looks and more visits than a run needs, which change nothing.
struct Watch {
  Recorder* recorder;       // none: nobody records
  plant::Machine* machine;  // none where a log is replayed
  bool every_tick = false;
  int extra_readers = 0;
  const std::atomic<bool>* stop = nullptr;
  bool was_stopped = false;

  // Has somebody asked for a stop? It is remembered.
  bool stopped() noexcept {
    was_stopped = was_stopped || (stop && stop->load(std::memory_order_relaxed));
    return was_stopped;
  }
  // The loop's side: a command, an edge, the instant of a sample, and the next tick to be visited.
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
  // The next tick at which something is recorded.
  signals::Tick sample_at() const noexcept {
    return recorder && !failed() ? recorder->next(0) : std::numeric_limits<signals::Tick>::max();
  }
  bool failed() const noexcept { return machine && machine->failure(); }
};

class RecordedRun {
 public:
  // From where the simulation stands, which outlives this.
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
  // Is a sample due at the next tick?
  bool samples(signals::Tick t) const noexcept { return t >= watch_.sample_at(); }

  // Leaves the body safe. Once.
  Outcome finish();

 private:
  Simulation& simulation_;
  std::optional<Recorder> recorder_;
  Watch watch_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace sinew::run
