// Walks in lanes: speedup over walks one after the other, and the time of ten thousand.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "sinew/run/simulation/lanes.h"

namespace {

using namespace sinew;

// Returns walks of test 1, each with different noise.
std::vector<experiment::Experiment> walks(std::size_t count) {
  const experiment::Experiment walk =
      experiment::load(std::string(SINEW_SOURCE_DIR) + "/experiments/walk-test-1.toml");
  std::vector<experiment::Experiment> out(count, walk);
  for (std::size_t i = 0; i < count; ++i) out[i].seed = static_cast<int>(i + 1);
  return out;
}

// Returns the time of these walks in `lanes` lanes on one thread [s].
double time_of(const std::vector<experiment::Experiment>& each, int lanes, bool recorded) {
  std::size_t next = 0;
  const auto start = std::chrono::steady_clock::now();
  run::run_in_lanes({.next = [&] { return next < each.size() ? &each[next++] : nullptr; },
                     .done = [](const experiment::Experiment&, const run::Outcome& out,
                                const std::exception_ptr&) { benchmark::DoNotOptimize(out.nodes); },
                     .most = lanes,
                     .recorded = recorded});
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Walks one after the other and in lanes, measured alternately.
void walks_in_lanes(benchmark::State& state, bool recorded) {
  const int lanes = static_cast<int>(state.range(0));
  if (lanes > 2 && lanes > run::widest_lanes())
    return state.SkipWithError("this processor has fewer lanes");
  const auto each = walks(static_cast<std::size_t>(8 * lanes));
  double alone = 1e9, beside = 1e9;  // shortest time of each, per walk [s]
  for (auto _ : state) {
    alone = std::min(alone, time_of(each, 1, recorded) / static_cast<double>(each.size()));
    beside = std::min(beside, time_of(each, lanes, recorded) / static_cast<double>(each.size()));
  }
  state.counters["ms_per_walk"] = 1e3 * beside;
  state.counters["ms_alone"] = 1e3 * alone;
  state.counters["times_faster"] = alone / beside;
}
BENCHMARK_CAPTURE(walks_in_lanes, recorded, true)->Arg(2)->Arg(4)->Arg(8)->Iterations(5);
BENCHMARK_CAPTURE(walks_in_lanes, unwatched, false)->Arg(2)->Arg(4)->Arg(8)->Iterations(5);

// Time of ten thousand walks on two threads, scaled from a thousand.
void ten_thousand_walks(benchmark::State& state, bool recorded) {
  const auto half = walks(500);
  double least = 1e9;  // [s]
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    std::thread other([&] { time_of(half, run::widest_lanes(), recorded); });
    time_of(half, run::widest_lanes(), recorded);
    other.join();
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    least = std::min(least, wall.count());
  }
  state.counters["lanes"] = run::widest_lanes();
  state.counters["s_for_10000"] = 10 * least;
}
BENCHMARK_CAPTURE(ten_thousand_walks, recorded, true)->Iterations(2)->UseRealTime();
BENCHMARK_CAPTURE(ten_thousand_walks, unwatched, false)->Iterations(2)->UseRealTime();

}  // namespace
