#include "sinew/run/simulation/run.h"

#include "sinew/host/realtime.h"
#include "sinew/port/recorded/recorded.h"
#include "sinew/run/simulation/clock.h"
#include "sinew/run/simulation/duty_sweep.h"
#include "sinew/run/simulation/recorded_run.h"
#include "sinew/run/simulation/simulation.h"

namespace sinew::run {

namespace {

// Runs a simulation from its present state to its end, with recording.
template <class Clock>
Outcome to_the_end(Simulation& simulation, const RunOptions& options, Clock& clock) {
  RecordedRun run(simulation, options);
  run.advance(simulation.last(), clock);
  Outcome out = run.finish();
  if (simulation.machine() != nullptr) out.nodes = simulation.machine()->nodes();
  return out;
}

Outcome by_its_clock(Simulation& simulation, const experiment::Experiment& e,
                     const RunOptions& options) {
  if (options.board && options.board_keeps_time) {
    SimulatedClock clock;
    return to_the_end(simulation, options, clock);
  }
  if (options.steering) {
    SteeredClock clock(*options.steering, 0.01 + e.log.period);
    return to_the_end(simulation, options, clock);
  }
  if (options.pace > 0) {
    PacedClock clock(options.pace);
    return to_the_end(simulation, options, clock);
  }
  SimulatedClock clock;
  return to_the_end(simulation, options, clock);
}

// The recorder allocates its memory before memory is locked, and the machine is made safe before it
// is unlocked.
Outcome in_real_time(const experiment::Experiment& e, const RunOptions& options) {
  signals::Port& body = *options.body.port;
  Simulation simulation(e, body, options.steering);
  RecordedRun run(simulation, options);
  Outcome out;
  {
    const host::RealTime real_time;
    options.body.beat->start();
    run.advance(simulation.last(), *options.body.beat);
    out = run.finish();
  }
  out.line = options.body.port->problem();
  return out;
}

}  // namespace

Outcome run(const experiment::Experiment& e, const RunOptions& options) {
  if (options.body.port) return in_real_time(e, options);
  if (options.board) {
    Simulation simulation(e, *options.board, options.lead, options.steering);
    return by_its_clock(simulation, e, options);
  }
  if (e.stand && e.stand->sweep.step > 0) return sweep_duties(e, options);
  Simulation simulation(e, options.steering);
  return by_its_clock(simulation, e, options);
}

Outcome replay(const experiment::Experiment& e, const signals::Table& recorded) {
  plant::Recorded port(e.robot, recorded);
  Simulation simulation(e, port);
  SimulatedClock clock;
  return to_the_end(simulation, {}, clock);
}

}  // namespace sinew::run
