#include "sinew/run/simulation/recorded_run.h"

namespace sinew::run {

using signals::Tick;

void Watch::sample(Tick t) noexcept {
  if (extra_readers == 0 && !(recorder && t >= recorder->next(t))) return;
  // A machine that has failed is not recorded.
  if (machine && t >= sample_at()) machine->advance(static_cast<double>(t) * signals::tick_seconds);
  if (failed()) return;
  for (int i = 0; i < extra_readers; ++i)
    if (machine) (void)machine->truth(static_cast<double>(t) * signals::tick_seconds);
  if (recorder) recorder->sample(t);
}

RecordedRun::RecordedRun(Simulation& simulation, const RunOptions& options)
    : simulation_(simulation),
      watch_{nullptr, simulation.machine(), options.every_tick, options.extra_readers,
             options.stop},
      start_(std::chrono::steady_clock::now()) {
  if (!options.recorded) return;
  watch_.recorder =
      &recorder_.emplace(simulation.experiment(), simulation.columns(), simulation.controllers(),
                         simulation.machine(), simulation.last(), options.topics);
  if (options.tap.push) recorder_->tap(options.tap, options.tapped);
  recorder_->progress(options.progress);
}

Outcome RecordedRun::finish() {
  Outcome out;
  out.status = simulation_.finish();
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start_;

  out.wall = wall.count();
  out.stopped = watch_.was_stopped;
  out.failure = simulation_.failure();
  if (const plant::Machine* machine = simulation_.machine()) out.took_air = machine->took_air();
  if (const RemoteBoards* far = simulation_.remote()) {
    out.line = far->problem();
    out.lost = far->lost();
    out.foreign = far->foreign();
  }
  add_end(simulation_.experiment(), simulation_.controllers(), recorder_ ? &*recorder_ : nullptr,
          simulation_.last(), out);
  return out;
}

void add_end(const experiment::Experiment& experiment, const Controllers& controllers,
             Recorder* recorder, Tick last, Outcome& out) {
  if (recorder) {
    out.table = recorder->take();
    out.no_room = recorder->problem();
  }
  out.controller = controllers.boards().controller_totals();
  out.supervised = controllers.boards().supervised_totals();
  out.duration = static_cast<double>(last) * signals::tick_seconds;
  if (const HighLevel* gait = controllers.gait()) {
    out.changes = gait->changes().all();
    out.unreachable_periods = gait->legs().unreachable_periods();
  } else {
    out.duration = experiment.stand->duration;
  }
  for (const signals::Series& s : out.table.series)
    if (!s.time_ns.empty() && s.topic.name.ends_with("/plan/phase"))
      out.duration = 1e-9 * static_cast<double>(s.time_ns.back());
}

}  // namespace sinew::run
