#include "sinew/run/simulation/run.h"

#include "sinew/plant/recorded/recorded.h"
#include "sinew/run/simulation/clock.h"
#include "sinew/run/simulation/recorded_run.h"
#include "sinew/run/simulation/simulation.h"

namespace sinew::run {

namespace {

// From where the simulation stands to its end, recorded.
template <class Clock>
Outcome to_the_end(Simulation& simulation, const RunOptions& options, Clock& clock) {
  RecordedRun run(simulation, options);
  run.advance(simulation.last(), clock);
  return run.finish();
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
