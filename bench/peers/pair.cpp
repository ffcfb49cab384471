#include "bench/peers/pair.h"

#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>

namespace sinew::bench {

namespace {

double now(Clock clock) {  // [s]
  const clockid_t by[] = {CLOCK_THREAD_CPUTIME_ID, CLOCK_PROCESS_CPUTIME_ID, CLOCK_MONOTONIC};
  timespec t{};
  clock_gettime(by[static_cast<int>(clock)], &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double per_unit(const Work& work, Clock clock) {
  double units = 0;
  const double seconds = seconds_of([&] { units = work(); }, clock);
  return seconds / units;
}

// Measures both works of a pair in one repetition.
void measure(benchmark::State& state, const Pair& pair, bool ours_first) {
  if (pair.before) pair.before();
  double ours = 0, theirs = 0;  // for one unit [s]
  if (ours_first) ours = per_unit(pair.ours, pair.clock);
  theirs = per_unit(pair.theirs, pair.clock);
  if (!ours_first) ours = per_unit(pair.ours, pair.clock);
  state.SetIterationTime(ours / theirs);
  state.counters["times_as_fast"] = theirs / ours;
  state.counters["ours_us"] = 1e6 * ours;
  state.counters["theirs_us"] = 1e6 * theirs;
  for (const auto& [name, value] : pair.figures) state.counters[name] = value;
  state.SetLabel(pair.label);
}

}  // namespace

double seconds_of(const std::function<void()>& work, Clock clock) {
  const double before = now(clock);
  work();
  return now(clock) - before;
}

double quantile(std::vector<double> values, double share) {
  std::ranges::sort(values);
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(std::floor(place));
  const std::size_t above = std::min(below + 1, values.size() - 1);
  const double part = place - static_cast<double>(below);
  return values[below] + part * (values[above] - values[below]);
}

void compare(const std::string& name, std::function<Pair()> make) {
  struct Kept {
    Pair pair;
    int repetitions = 0;
  };
  const auto run = [make = std::move(make),
                    kept = std::make_shared<Kept>()](benchmark::State& state) {
    try {
      if (!kept->pair.ours) {
        kept->pair = make();
        // The first run of each is slower and is not counted.
        if (kept->pair.before) kept->pair.before();
        kept->pair.ours();
        kept->pair.theirs();
      }
      for (auto _ : state) measure(state, kept->pair, kept->repetitions++ % 2 == 0);
    } catch (const std::exception& e) {
      state.SkipWithError(e.what());
    }
  };
  benchmark::RegisterBenchmark(name.c_str(), run)
      ->UseManualTime()
      ->Iterations(1)
      ->Unit(benchmark::kSecond)
      ->ComputeStatistics("p5", [](const std::vector<double>& v) { return quantile(v, 0.05); })
      ->ComputeStatistics("p95", [](const std::vector<double>& v) { return quantile(v, 0.95); });
}

}  // namespace sinew::bench
