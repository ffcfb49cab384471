// Many walks: in lanes of one thread, and on two threads.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "bench/peers/experiments.h"
#include "bench/peers/pair.h"
#include "sinew/run/simulation/lanes.h"
#include "sinew/tune/sweep.h"

namespace sinew::bench {

namespace {

// Compares walks in lanes with the same walks one after the other.
Pair beside(int lanes, bool recorded) {
  if (lanes > 2 && lanes > run::widest_lanes())
    throw std::runtime_error("this processor has fewer lanes");
  const auto each = walks(2 * lanes);
  return {.ours = [=] { return in_lanes(each, lanes, recorded); },
          .theirs = [=] { return in_lanes(each, 1, recorded); },
          .label = "walks in lanes of one thread, against one after the other"};
}

// Returns the results of a sweep by point, which do not depend on the number of threads.
std::vector<std::string> sweep(const tune::Runner& runner, int threads) {
  constexpr std::size_t points = 64;
  std::vector<std::size_t> all(points);
  std::iota(all.begin(), all.end(), std::size_t{0});
  std::vector<std::string> rows(points);
  runner.run(all, threads, [&](const tune::Row& row) {
    for (const std::string& cell : row.cells) rows[row.point] += cell + ",";
  });
  return rows;
}

Pair two_threads(Clock clock) {
  const auto runner = std::make_shared<tune::Runner>(
      tune::Sweep{.experiment = experiment_file("walk-test-1.toml"),
                  .axes = {tune::seeds(64)},
                  .report = tune::parse_figures("trolley.distance_m")});
  if (sweep(*runner, 2) != sweep(*runner, 1))
    throw std::runtime_error("two threads and one gave different rows of the sweep");
  const auto on = [=](int threads) -> Work {
    return [=] { return static_cast<double>(sweep(*runner, threads).size()); };
  };
  return {.ours = on(2),
          .theirs = on(1),
          .clock = clock,
          .label = "a sweep of walks on two threads, against one"};
}

// Compares the rows of a sweep with the same walks alone, of which nothing is recorded.
Pair sweep_row() {
  const auto runner = std::make_shared<tune::Runner>(
      tune::Sweep{.experiment = experiment_file("walk-test-1.toml"),
                  .axes = {tune::seeds(64)},
                  .report = tune::parse_figures("trolley.distance_m")});
  const auto each = walks(64);
  (void)sweep(*runner, 1);  // the first runs find what a row needs
  return {.ours = [=] { return static_cast<double>(sweep(*runner, 1).size()); },
          .theirs = [=] { return in_lanes(each, run::widest_lanes(), false); },
          .label = "a row of a sweep, against its run"};
}

// Runs a thousand walks on two threads in the processor's lanes.
void thousand_walks(benchmark::State& state, bool recorded) {
  const auto half = walks(500);
  for (auto _ : state) {
    std::thread other([&] { in_lanes(half, run::widest_lanes(), recorded); });
    in_lanes(half, run::widest_lanes(), recorded);
    other.join();
  }
}

const Registration rows([] {
  for (const int lanes : {2, 4, 8}) {
    compare(fmt::format("cost/beside-{}", lanes), [=] { return beside(lanes, false); });
    compare(fmt::format("cost/beside-{}-recorded", lanes), [=] { return beside(lanes, true); });
  }
  compare("cost/sweep-row", [] { return sweep_row(); });
  compare("threads/two", [] { return two_threads(Clock::wall); });
  compare("threads/work", [] { return two_threads(Clock::all_threads); });
});
BENCHMARK_CAPTURE(thousand_walks, unwatched, false)
    ->Name("threads/thousand")
    ->Iterations(1)
    ->Repetitions(3)
    ->Unit(benchmark::kSecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(thousand_walks, recorded, true)
    ->Name("threads/thousand-recorded")
    ->Iterations(1)
    ->Repetitions(3)
    ->Unit(benchmark::kSecond)
    ->UseRealTime();

}  // namespace

}  // namespace sinew::bench
