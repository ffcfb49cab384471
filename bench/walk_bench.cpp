// Times of the parts of a walk.
#include <benchmark/benchmark.h>

#include "bench/peers/experiments.h"
#include "sinew/run/setup/machine_setup.h"
#include "sinew/run/simulation/run.h"
#include "sinew/world/machine.h"

namespace {

using namespace sinew;
using bench::walk;

// The whole closed loop with the channel table in memory and without a log, as `sinew run` with
// --set log.enabled=false.
void closed_loop_walk(benchmark::State& state) {
  double simulated = 0;
  std::int64_t nodes = 0;
  for (auto _ : state) {
    const run::Outcome out = run::run(walk());
    simulated += out.duration;
    nodes += out.nodes;
  }
  state.counters["real_time_factor"] = benchmark::Counter(simulated, benchmark::Counter::kIsRate);
  state.counters["nodes"] =
      benchmark::Counter(static_cast<double>(nodes), benchmark::Counter::kIsRate);
}
BENCHMARK(closed_loop_walk)->Name("parts/closed-loop-walk")->Unit(benchmark::kMillisecond);

// Measures the same walk without recording.
void unwatched_walk(benchmark::State& state) {
  double simulated = 0;
  for (auto _ : state) {
    plant::ChainWorld<2> world(run::planar_setup(walk()));
    simulated += bench::drive(world, walk());
  }
  state.counters["real_time_factor"] = benchmark::Counter(simulated, benchmark::Counter::kIsRate);
}
BENCHMARK(unwatched_walk)->Name("parts/unwatched-walk")->Unit(benchmark::kMillisecond);

// Gait controller, joint controllers and loop, with a body that always returns the same readings.
class Still final : public signals::Port {
 public:
  signals::Status start(const signals::Scan&) noexcept override { return signals::Status::ok; }
  signals::Status drive(signals::Edge) noexcept override { return signals::Status::ok; }
  signals::Reading read(signals::Channel c, signals::Tick t) noexcept override {
    return {static_cast<std::uint16_t>(700 + 10 * c.index + t % 7), signals::Status::ok};
  }
  signals::Status stop(signals::Tick) noexcept override { return signals::Status::ok; }
};

void controller_alone(benchmark::State& state) {
  double simulated = 0;
  for (auto _ : state) {
    Still body;
    simulated += bench::drive(body, walk());
  }
  state.counters["real_time_factor"] = benchmark::Counter(simulated, benchmark::Counter::kIsRate);
}
BENCHMARK(controller_alone)->Name("parts/controller-alone")->Unit(benchmark::kMillisecond);

// One 1 ms step of the leg in stance: four stages, friction, contact.
void one_node(benchmark::State& state) {
  plant::ChainWorld<2> world(run::planar_setup(walk()));
  double t = 0.5;
  world.advance(t);
  for (auto _ : state) world.advance(t += 1e-3);
}
BENCHMARK(one_node)->Name("parts/one-node");

// One evaluation between two nodes.
void one_preview(benchmark::State& state) {
  plant::ChainWorld<2> world(run::planar_setup(walk()));
  for (auto _ : state) benchmark::DoNotOptimize(world.truth(0.5005));
}
BENCHMARK(one_preview)->Name("parts/one-preview");

struct FourMuscles {
  using Air = air::AirNetwork<plant::chain_muscles>;
  plant::Setup setup = run::planar_setup(walk());
  Air air{setup.muscles, setup.air, setup.supply};
  Air::Valves valves = air.valves_at_rest();
  Air::Ends ends{};
  Air::State state;
  Air::Memory memory;
  Air::Evaluation evaluation;

  FourMuscles() {
    ends.length.of.fill(0.08);
    state = air.initial(3e5, ends.length, 0);
    memory = air.memory_at_rest(3e5, ends.length);
    air.evaluate(0, ends, state, valves, memory, evaluation);
    air.update_memory(evaluation, state, memory);
  }
};

// Tensions and pressures of four muscles in independent evaluations (throughput) ...
void four_muscles(benchmark::State& state) {
  FourMuscles m;
  for (auto _ : state) {
    m.air.evaluate(0, m.ends, m.state, m.valves, m.memory, m.evaluation);
    benchmark::DoNotOptimize(m.evaluation);
  }
}
BENCHMARK(four_muscles)->Name("parts/four-muscles");

// ... and in evaluations that depend on the previous result, as the stages of a step do.
void four_muscles_in_sequence(benchmark::State& state) {
  FourMuscles m;
  for (auto _ : state) {
    m.ends.length[0] = 0.08 + 1e-12 * m.evaluation.tension[0];
    m.air.evaluate(0, m.ends, m.state, m.valves, m.memory, m.evaluation);
  }
  benchmark::DoNotOptimize(m.evaluation);
}
BENCHMARK(four_muscles_in_sequence)->Name("parts/four-muscles-in-sequence");

// Mass matrix, its factorization and the accelerations of the two-link leg on its trolley.
void body_accelerations(benchmark::State& state) {
  const plant::ChainConstants<2> k = plant::chain_of<2>(walk().robot);
  plant::GeneralizedState<2> motion;
  motion.angle = {5.1, 9.9};
  motion.rate = {0.1, 0.2};
  for (auto _ : state) {
    const plant::Chain<2> chain(k, motion);
    const plant::GeneralizedVector<2> a = chain.accelerations({.x = 1.0, .angle = {0.1, 0.2}});
    motion.angle[0] += 1e-15 * a.x;
  }
  benchmark::DoNotOptimize(motion);
}
BENCHMARK(body_accelerations)->Name("parts/body-accelerations");

}  // namespace
