// The test stand, two seconds of appendix A: 25 Hz and 5 lb. Each program uses the longest step, or
// the loosest tolerance, with which every length is within the required error of its own limit.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>

#include "bench/appendix_a.h"
#include "bench/peers/experiments.h"
#include "bench/peers/pair.h"
#include "bench/peers/stand_peers.h"
#include "sinew/experiment/experiment.h"
#include "sinew/run/setup/machine_setup.h"
#include "sinew/units/constants.h"
#include "sinew/world/stand.h"

namespace sinew::bench {

namespace {

constexpr int milliseconds = appendix_a_milliseconds, period = 40;  // [ms]

// One implementation, with settings of increasing accuracy; setting 0 is the limit. `run` writes
// the length every `every` milliseconds.
struct Program {
  int settings = 0;
  std::function<void(int setting, int every, Lengths& out)> run;
  std::function<std::string(int setting)> says;
};

double largest_difference(const Lengths& a, const Lengths& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::fabs(a[i] - b[i]));
  return most;
}

// Coarsest setting that is accurate enough, and its error [in]; setting 0 if no setting is.
struct Chosen {
  int setting = 0;
  double error = 0;
};
Chosen choose(const Program& p, double error) {
  Lengths exact(milliseconds), l(milliseconds);
  p.run(0, 1, exact);
  for (int s = 1; s <= p.settings; ++s) {
    p.run(s, 1, l);
    const double found = largest_difference(l, exact);
    if (found <= error) return {s, found};
  }
  return {};
}

// --- Sinew: nodes and the accuracy between them ---

struct Steps {
  double node = 0, accuracy = 0;  // [s], [-]
};
constexpr Steps our_steps[] = {{1e-5, 1e-9},   {8e-3, 1e-5},   {4e-3, 1e-5},
                               {8e-3, 3.4e-7}, {2e-3, 3.4e-7}, {1e-3, 3.4e-7}};

void our_stand(int setting, int every, Lengths& out) {
  static const plant::StandSetup setup =
      run::stand_setup(experiment::load(experiment_file("rig/pwm-25hz-5lb.toml")));
  plant::StandSetup s = setup;
  s.step = our_steps[setting].node;
  s.accuracy = our_steps[setting].accuracy;
  plant::Stand stand(s);
  for (int ms = 0; ms < milliseconds; ++ms) {
    const signals::Tick t = 10 * ms;
    if (ms % period == 0) stand.drive({.at = t, .open = true});
    if (ms % period == 16) stand.drive({.at = t, .open = false});
    if ((ms + 1) % every == 0)
      out[static_cast<std::size_t>(ms)] = stand.truth(1e-3 * (ms + 1)).length / units::inch;
  }
}

Program ours() {
  return {5, our_stand,
          [](int s) { return fmt::format("nodes every {:g} ms", 1e3 * our_steps[s].node); }};
}

// --- peers ---

constexpr int thesis_steps[] = {4000, 1, 2, 5, 10, 20, 50, 100, 120, 150, 200, 500, 1000};

Program thesis() {
  return {12, [](int s, int, Lengths& out) { appendix_a(thesis_steps[s], out.data()); },
          [](int s) { return fmt::format("{} steps of RK4 in a millisecond", thesis_steps[s]); }};
}

// Returns the tolerance of a setting: from 1e-2 downwards in thirds of a decade.
double tolerance(int setting) {
  return setting == 0 ? 1e-12 : 1e-2 * std::pow(10.0, -(setting - 1) / 3.0);
}
Program adaptive(void (*run)(double, int, Lengths&)) {
  return {27, [run](int s, int every, Lengths& out) { run(tolerance(s), every, out); },
          [](int s) { return fmt::format("tolerance {:.1e}", tolerance(s)); }};
}

// Compares both with their coarsest settings of at most this error [in], by the run of 2 s.
Pair against(const Program& peer, double error) {
  const Program own = ours();
  const Chosen mine = choose(own, error), other = choose(peer, error);
  if (other.setting == 0 || mine.setting == 0)
    throw std::runtime_error("no step or tolerance that was tried is as exact");
  // Each repetition runs a program several times, for some 10 ms.
  const auto work = [](const Program& p, int setting) -> Work {
    const auto lengths = std::make_shared<Lengths>(milliseconds);
    const auto once = [=] { p.run(setting, period, *lengths); };
    const double seconds = seconds_of(
        [&] {
          for (int i = 0; i < 3; ++i) once();
        },
        Clock::processor);
    const int times = std::clamp(static_cast<int>(0.03 / seconds), 1, 1000);
    return [=] {
      for (int i = 0; i < times; ++i) once();
      return 1.0 * times;
    };
  };
  return {.ours = work(own, mine.setting),
          .theirs = work(peer, other.setting),
          .label =
              fmt::format("ours, {}, against {}", own.says(mine.setting), peer.says(other.setting)),
          .figures = {{"our_error_in", mine.error}, {"their_error_in", other.error}}};
}

const Registration rows([] {
  std::vector<std::pair<std::string, Program>> programs{{"thesis", thesis()}};
  for (const StandPeer& peer : stand_peers()) {
    programs.emplace_back(peer.name, adaptive(peer.run));
    benchmark::AddCustomContext(peer.name, peer.version);
  }
  for (const double error : {2e-4, 1e-5, 2e-6})
    for (const auto& [name, program] : programs)
      compare(fmt::format("stand/{}-{:.0e}", name, error),
              [program = program, error] { return against(program, error); });
});

}  // namespace

std::vector<StandPeer> stand_peers() {
  std::vector<StandPeer> out;
#if defined(SINEW_BENCH_CVODE)
  out.push_back(cvode_stand());
#endif
#if defined(SINEW_BENCH_ODEINT)
  out.push_back(odeint_stand());
#endif
  return out;
}

}  // namespace sinew::bench
