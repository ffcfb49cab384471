#include "sinew/experiment/run.h"

#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "sinew/experiment/clock.h"
#include "sinew/experiment/simulation.h"
#include "sinew/plant/recorded/recorded.h"
#include "sinew/robot/actuator_of.h"

namespace sinew::experiment {

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
  Recorder recorder(simulation.experiment(), simulation.spine(), simulation.high_level(), truth,
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
  out.seen = simulation.spine().seen();
  out.supervised = simulation.spine().supervised();
  out.changes = simulation.high_level().changes().all();
  out.unreachable_periods = simulation.high_level().brain().unreachable_periods();
  out.duration = static_cast<double>(simulation.last()) * signals::tick_seconds;
  for (const signals::Series& s : out.table.series)
    if (!s.time_ns.empty() && s.topic.name == "/plan/phase")
      out.duration = 1e-9 * static_cast<double>(s.time_ns.back());
  return out;
}

}  // namespace

Tick last_tick(const Experiment& e) {
  const double vent = e.plan.finish == gait::Plan::Finish::vent ? e.robot.low_level.vent_time : 0.0;
  const auto brain_ticks = std::llround(e.plan.brain_period / signals::tick_seconds);
  const Tick plan = gait::periods(e.plan) * brain_ticks;
  // One period for the last valves to shut, and for a sample of where the plan has led to.
  const Tick last = e.robot.low_level.pwm_ticks;
  return plan + std::llround(vent / signals::tick_seconds) + last;
}

namespace {

const gas::Valve* find_valve(const Experiment& e, const std::string& name) {
  for (const gas::Valve& v : e.valves)
    if (v.name == name) return &v;
  return nullptr;
}

// The robot's cylinder with its valves, if it moves.
std::optional<muscle::Cylinder> cylinder_of(const Experiment& e) {
  using Mode = robot::Cylinder::Mode;
  const robot::Cylinder& c = e.robot.cylinder;
  if (!c.present || c.mode == Mode::locked) return {};
  muscle::Cylinder out{.bore = c.bore,
                       .rod_diameter = c.rod_diameter,
                       .stroke = c.stroke,
                       .dead_volume = {c.up.dead_volume, c.down.dead_volume},
                       .pressure = c.pressure,
                       .initial_pressure = {e.start.pressure, e.start.pressure}};
  if (c.mode == Mode::regulator) {
    out.mode = muscle::Cylinder::Mode::regulator;
    return out;
  }
  for (const muscle::Side side : {muscle::up, muscle::down}) {
    const robot::Cylinder::Chamber& chamber = side == muscle::up ? c.up : c.down;
    if (const gas::Valve* v = find_valve(e, chamber.inlet)) out.inlet[side] = *v;
    if (const gas::Valve* v = find_valve(e, chamber.exhaust)) out.exhaust[side] = *v;
  }
  return out;
}

}  // namespace

plant::Setup planar_setup(const Experiment& e) {
  plant::Setup s{.robot = e.robot, .air = e.air, .supply = e.supply};
  for (const robot::Muscle& m : e.robot.muscles) {
    muscle::Muscle out{.name = m.name, .count = m.count, .external_volume = m.external_volume};
    out.actuator = robot::actuator_of(m, e.actuators);
    if (const gas::Valve* v = find_valve(e, m.inlet)) out.inlet = *v;
    if (const gas::Valve* v = find_valve(e, m.exhaust)) out.exhaust = *v;
    out.hose = m.hose;
    out.leak = m.leak;
    s.muscles.push_back(std::move(out));
  }
  for (const robot::Joint& j : e.robot.joints) {
    s.start.joint_angle.push_back(e.start.joint_angles.at(j.name));
    bool blocked = false;
    for (const std::string& name : e.start.blocked) blocked = blocked || name == j.name;
    s.start.blocked.push_back(blocked);
  }
  s.cylinder = cylinder_of(e);
  s.start.trolley = e.start.trolley;
  s.start.lift = e.start.lift;
  s.start.pressure = e.start.pressure;
  s.steps.body = e.body_step;
  s.seed = static_cast<std::uint64_t>(e.seed);
  return s;
}

Outcome run(const Experiment& e, const RunOptions& options) {
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

Outcome replay(const Experiment& e, const signals::Table& recorded) {
  plant::Recorded port(e.robot, recorded);
  Simulation simulation(e, port);
  SimulatedClock clock;
  return to_the_end(simulation, {}, clock);
}

}  // namespace sinew::experiment
