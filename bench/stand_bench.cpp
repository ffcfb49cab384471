// The test stand beside the thesis's own program of it (appendix_a.h), each at the longest step
// with which it is as exact as is asked for, run by turns. The goals (bench/README.md) are ratios.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "bench/appendix_a.h"
#include "sinew/experiment/rig/rig.h"
#include "sinew/plant/slide/stand.h"
#include "sinew/units/constants.h"

namespace {

using namespace sinew;
using Lengths = std::vector<double>;  // at the end of each millisecond [in]

constexpr int milliseconds = bench::appendix_a_milliseconds;

struct Steps {
  double node = 0, accuracy = 0;  // of the stand: [s], [-]
};

const plant::StandSetup& setup() {
  static const plant::StandSetup s = rig::setup_of(
      rig::load(std::string(SINEW_SOURCE_DIR) + "/experiments/rig/pwm-25hz-5lb.toml"));
  return s;
}

// The appendix's two seconds on the stand, looked at each `every` ms.
void stand(const Steps& steps, int every, Lengths& out) {
  plant::StandSetup s = setup();
  s.step = steps.node;
  s.accuracy = steps.accuracy;
  plant::Stand stand(s);
  for (int ms = 0; ms < milliseconds; ++ms) {
    const signals::Tick t = 10 * ms;
    if (ms % 40 == 0) stand.drive({.at = t, .open = true});
    if (ms % 40 == 16) stand.drive({.at = t, .open = false});
    if ((ms + 1) % every == 0)
      out[static_cast<std::size_t>(ms)] = stand.truth(1e-3 * (ms + 1)).length / units::inch;
  }
}

double largest_difference(const Lengths& a, const Lengths& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::fabs(a[i] - b[i]));
  return most;
}

// The fewest of the appendix's steps per ms that are as exact, against 4000.
int steps_of_the_thesis(double error) {
  static const Lengths exact = [] {
    Lengths l(milliseconds);
    bench::appendix_a(4000, l.data());
    return l;
  }();
  Lengths l(milliseconds);
  for (const int n : {1, 2, 5, 10, 20, 50, 100, 120, 150, 200, 500}) {
    bench::appendix_a(n, l.data());
    if (largest_difference(l, exact) <= error) return n;
  }
  return 1000;
}

// The longest of the stand's nodes and pieces that are, against 10 us.
Steps steps_of_the_stand(double error) {
  static const Lengths exact = [] {
    Lengths l(milliseconds);
    stand({1e-5, 1e-9}, 1, l);
    return l;
  }();
  Lengths l(milliseconds);
  for (const Steps s : {Steps{8e-3, 1e-5}, {4e-3, 1e-5}, {8e-3, 3.4e-7}, {2e-3, 3.4e-7}}) {
    stand(s, 1, l);
    if (largest_difference(l, exact) <= error) return s;
  }
  return {1e-3, 3.4e-7};
}

double seconds_since(std::chrono::steady_clock::time_point before) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
}

// Both by turns, looked at once in each period of the valve; the argument is the largest error of
// the length in nanoinches.
void stand_against_the_thesis(benchmark::State& state) {
  const double error = 1e-9 * static_cast<double>(state.range(0));
  const int per_ms = steps_of_the_thesis(error);
  const Steps steps = steps_of_the_stand(error);
  Lengths l(milliseconds);
  double thesis = 0, ours = 0;
  for (auto _ : state) {
    const auto before = std::chrono::steady_clock::now();
    bench::appendix_a(per_ms, l.data());
    thesis += seconds_since(before);
    const auto between = std::chrono::steady_clock::now();
    stand(steps, 40, l);
    ours += seconds_since(between);
  }
  const auto runs = static_cast<double>(state.iterations());
  state.counters["thesis_us"] = 1e6 * thesis / runs;
  state.counters["stand_us"] = 1e6 * ours / runs;
  state.counters["times_faster"] = thesis / ours;
  state.counters["thesis_step_us"] = 1e3 / per_ms;
  state.counters["stand_node_us"] = 1e6 * steps.node;
}
BENCHMARK(stand_against_the_thesis)
    ->Arg(200'000)
    ->Arg(10'000)
    ->Arg(2'000)
    ->Unit(benchmark::kMillisecond);

}  // namespace
