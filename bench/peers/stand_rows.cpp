// The test stand, two seconds of appendix A: 25 Hz and 5 lb. Each program uses the longest step, or
// the loosest tolerance, with which every length is within the required error of its own limit.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "bench/appendix_a.h"
#include "bench/peers/experiments.h"
#include "bench/peers/row.h"
#include "bench/peers/stand_peers.h"
#include "sinew/experiment/experiment.h"
#include "sinew/run/setup/stand_setup.h"
#include "sinew/units/constants.h"
#include "sinew/world/stand.h"

namespace sinew::bench {

namespace {

constexpr int milliseconds = appendix_a_milliseconds, period = 40;  // [ms]

// One implementation, with settings of increasing accuracy; setting 0 is the limit. `run` writes
// the length every `every` milliseconds.
struct Program {
  std::string name;
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
  return {"sinew", 5, our_stand,
          [](int s) { return fmt::format("nodes every {:g} ms", 1e3 * our_steps[s].node); }};
}

// --- peers ---

constexpr int thesis_steps[] = {4000, 1, 2, 5, 10, 20, 50, 100, 120, 150, 200, 500, 1000};

Program thesis() {
  return {"thesis", 12, [](int s, int, Lengths& out) { appendix_a(thesis_steps[s], out.data()); },
          [](int s) { return fmt::format("{} steps of RK4 in a millisecond", thesis_steps[s]); }};
}

// Returns the tolerance of a setting: from 1e-2 downwards in thirds of a decade.
double tolerance(int setting) {
  return setting == 0 ? 1e-12 : 1e-2 * std::pow(10.0, -(setting - 1) / 3.0);
}
Program adaptive(const std::string& name, void (*run)(double, int, Lengths&)) {
  return {name, 27, [run](int s, int every, Lengths& out) { run(tolerance(s), every, out); },
          [](int s) { return fmt::format("tolerance {:.1e}", tolerance(s)); }};
}

Row against(const Program& own, const Program& peer, double error, std::optional<double> goal,
            int rounds) {
  const Chosen mine = choose(own, error), other = choose(peer, error);
  Row row{
      .name = fmt::format("stand/{}-{:.0e}", peer.name, error),
      .what = fmt::format("two seconds of the test stand, no length further than {:.0e} in from "
                          "its own limit: ours, {}, against {}, {}",
                          error, own.says(mine.setting), peer.name, peer.says(other.setting)),
      .goal = goal,
      .per = "run of 2 s"};
  const std::string what = "length, largest difference from its own limit";
  row.accuracy = {{"sinew", what, mine.error, "in"}, {peer.name, what, other.error, "in"}};
  if (other.setting == 0 || mine.setting == 0)
    return not_measured(row, "no step or tolerance that was tried is as exact");
  Lengths l(milliseconds);
  const auto several = [&l](const Program& p, int setting, int times) {
    for (int i = 0; i < times; ++i) p.run(setting, period, l);
    return static_cast<double>(times);
  };
  // Runs each for some 10 ms per turn.
  const auto times = [&](const Program& p, int setting) {
    const double once = seconds_of([&] { several(p, setting, 3); }, Clock::processor) / 3;
    return std::clamp(static_cast<int>(0.01 / once), 1, 1000);
  };
  const int own_times = times(own, mine.setting), peer_times = times(peer, other.setting);
  return times_faster(row, by_turns([&] { return several(own, mine.setting, own_times); },
                                    [&] { return several(peer, other.setting, peer_times); },
                                    rounds, Clock::processor));
}

}  // namespace

std::vector<Row> stand_rows(const Effort& effort) {
  std::vector<Row> rows;
  for (const double error : {2e-4, 1e-5, 2e-6}) {
    rows.push_back(against(ours(), thesis(), error, 1.8, effort.rounds));
    const auto one = [&](const std::string& name, const std::string& version,
                         void (*run)(double, int, Lengths&), std::optional<double> goal) {
      if (version == "none")
        rows.push_back(not_measured({.name = fmt::format("stand/{}-{:.0e}", name, error)},
                                    name + " was not found when this program was built"));
      else
        rows.push_back(against(ours(), adaptive(name, run), error, goal, effort.rounds));
    };
    one("cvode", cvode_version(), by_cvode, 25.0);
    one("odeint", odeint_version(), by_odeint, std::nullopt);
  }
  return rows;
}

}  // namespace sinew::bench
