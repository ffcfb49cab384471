#include "sinew/run/simulation/run.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "sinew/host/side_by_side.h"
#include "sinew/port/recorded/recorded.h"
#include "sinew/run/simulation/clock.h"
#include "sinew/run/simulation/recorded_run.h"
#include "sinew/run/simulation/simulation.h"

namespace sinew::run {

namespace {

using signals::Tick;

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

// --- a sweep of a pulsed test stand: each duty on a separate stand, all with the same start ---

// Means over the last five periods.
struct Settled {
  double duty = 0;                // commanded
  double length = 0, ripple = 0;  // mean, range [m]
  double pressure = 0;            // mean, absolute [Pa]
  double force = 0;               // mean [N]
  air::Failure failure;
};

// Sums length, pressure and force, tick by tick.
struct Periods {
  plant::Machine& machine;
  Tick from;
  Settled sum;
  plant::Truths truths = {};
  double shortest = 1e9, longest = 0;
  std::int64_t count = 0;

  void command(Tick) noexcept {}
  void edge(const signals::Edge&) noexcept {}
  void sample(Tick t) noexcept {
    if (t < from) return;
    machine.truth(static_cast<double>(t) * signals::tick_seconds, truths);
    const plant::StandTruth& x = truths.stand;
    sum.length += x.length;
    sum.pressure += x.pressure;
    sum.force += x.force;
    shortest = std::min(shortest, x.length);
    longest = std::max(longest, x.length);
    ++count;
  }
  Tick next(Tick t) const noexcept { return t < from ? from : t + 1; }
};

Settled settled(experiment::Experiment e, double duty) {
  e.stand->drive.duty = duty;
  e.stand->drive.duties.clear();
  const Tick period = std::llround(e.stand->drive.period / signals::tick_seconds);
  const Tick end = std::llround(e.stand->duration / signals::tick_seconds) / period * period;
  Simulation simulation(e);
  SimulatedClock clock;
  Periods last{
      .machine = *simulation.machine(), .from = std::max<Tick>(0, end - 5 * period), .sum = {}};
  simulation.advance(end, clock, last);
  const auto n = static_cast<double>(last.count);
  return {.duty = duty,
          .length = last.sum.length / n,
          .ripple = last.longest - last.shortest,
          .pressure = last.sum.pressure / n,
          .force = last.sum.force / n,
          .failure = simulation.failure()};
}

std::vector<Settled> all_settled(const experiment::Experiment& e, int threads) {
  const experiment::Stand::Sweep& sweep = e.stand->sweep;
  const auto count =
      static_cast<std::size_t>(std::floor((sweep.to - sweep.from) / sweep.step + 1e-9)) + 1;
  std::vector<Settled> out(count);
  host::side_by_side(
      count,
      [&](std::size_t i) { out[i] = settled(e, sweep.from + static_cast<double>(i) * sweep.step); },
      nullptr, threads);
  return out;
}

// The table has a row per duty: the settled values of the stand. The result does not depend on the
// number of threads.
Outcome sweep_duties(const experiment::Experiment& e, const RunOptions& options) {
  const auto before = std::chrono::steady_clock::now();
  const std::vector<Settled> all = all_settled(e, options.threads);
  Outcome out{.duration = e.stand->duration};
  for (const Settled& s : all)
    if (!out.failure) out.failure = s.failure;
  double Settled::*const which[] = {&Settled::duty, &Settled::length, &Settled::ripple,
                                    &Settled::pressure, &Settled::force};
  for (const signals::Topic& topic : topics(e)) {
    const std::size_t column = out.table.series.size();
    signals::Series& series = out.table.series.emplace_back(signals::Series{topic, {}, {{}}});
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double value = all[i].*which[column];
      series.time_ns.push_back(std::llround(1e9 * e.stand->duration) *
                               static_cast<std::int64_t>(i + 1));
      series.columns[0].push_back(value);
      if (options.tap.push && options.tapped[column] != not_tapped)
        options.tap.push(options.tap.object, options.tapped[column], series.time_ns.back(),
                         {&value, 1});
    }
  }
  out.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
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
