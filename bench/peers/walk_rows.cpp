// The whole closed loop: gait controller, joint controllers, air and body, with actions in every
// period.
#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <string>
#include <vector>

#include "bench/peers/experiments.h"
#include "bench/peers/mujoco_leg.h"
#include "bench/peers/row.h"
#include "sinew/run/setup/planar_setup.h"
#include "sinew/run/simulation/lanes.h"
#include "sinew/units/constants.h"
#include "sinew/world/machine.h"

namespace sinew::bench {

namespace {

using experiment::Experiment;

// Runs one walk of Sinew without recording; returns the final position of the trolley [m].
double our_walk(const Experiment& e) {
  plant::ChainWorld<2> world(run::planar_setup(e));
  const double end = drive(world, e);
  return world.truth(end).x;
}

double their_walk(const Experiment& e, const LegSteps& steps = {}) {
  MujocoLeg leg(run::planar_setup(e), steps);
  drive(leg, e);
  return leg.motion().x;
}

// Runs walks with different noise in all lanes of the processor; returns their number.
double walks_in_lanes(const std::vector<Experiment>& each) {
  std::size_t next = 0;
  run::run_in_lanes(
      {.next = [&] { return next < each.size() ? &each[next++] : nullptr; },
       .done = [](const Experiment&, const run::Outcome&, const std::exception_ptr&) {},
       .most = run::widest_lanes(),
       .recorded = false});
  return static_cast<double>(each.size());
}

// Returns the walk on a long track, since the end of the track would make all distances equal.
Experiment with_step(double step) {
  Experiment e = walk();
  e.body_step = step;
  e.robot.trolley.track_length = 9;
  return e;
}

// Returns the mean distance over several seeds of the sensors' noise [in], since a single walk is
// random.
double mean_way(const std::function<double(const Experiment&)>& way, double step, int walks) {
  double sum = 0;
  for (int seed = 1; seed <= walks; ++seed) {
    Experiment e = with_step(step);
    e.seed = seed;
    sum += way(e);
  }
  return sum / walks / units::inch;
}

std::vector<Accuracy> ways() {
  constexpr int walks = 5;
  const auto ours = [](const Experiment& e) { return our_walk(e); };
  const auto theirs = [](const Experiment& e) { return their_walk(e); };
  const auto theirs_finer = [](const Experiment& e) {
    return their_walk(e, {.body = 1, .muscle = 4});
  };
  const std::string mean = "distance, mean of five walks";
  const std::string error = "distance, mean of five walks, from steps ";
  const double a = mean_way(ours, 1e-3, walks), b = mean_way(theirs, 1e-3, walks);
  return {{"sinew", mean, a, "in"},
          {"sinew", error + "a tenth as long", std::fabs(a - mean_way(ours, 1e-4, walks)), "in"},
          {"mujoco", mean, b, "in"},
          {"mujoco", error + "a tenth and a quarter as long",
           std::fabs(b - mean_way(theirs_finer, 1e-3, walks)), "in"}};
}

}  // namespace

std::vector<Row> walk_rows(const Effort& effort) {
  Row alone{.name = "walk/mujoco-pow",
            .what =
                "test 1 with the real controller, contacts on, actions in every period, no "
                "recording: ours against MuJoCo (Euler, 1 ms) with scalar pow RK4 muscles "
                "(100 us), one machine each",
            .goal = 28.0,
            .per = "walk"};
  Row beside{.name = "walk/mujoco-pow-lanes",
             .what = "the same, ours side by side in the processor's lanes, on one thread",
             .goal = 28.0,
             .per = "walk"};
  if (!has_mujoco()) {
    const std::string why = "MuJoCo was not found when this program was built";
    return {not_measured(alone, why), not_measured(beside, why)};
  }
  alone.accuracy = ways();
  std::vector<Experiment> each(static_cast<std::size_t>(2 * run::widest_lanes()), walk());
  for (std::size_t i = 0; i < each.size(); ++i) each[i].seed = static_cast<int>(i + 1);
  const Work theirs = [&] { return their_walk(walk()) != 0 ? 1.0 : 1.0; };
  const Work one = [&] {
    for (int i = 0; i < 8; ++i) our_walk(each[static_cast<std::size_t>(i % 2)]);
    return 8.0;
  };
  return {times_faster(alone, by_turns(one, theirs, effort.rounds, Clock::processor)),
          times_faster(beside, by_turns([&] { return walks_in_lanes(each); }, theirs, effort.rounds,
                                        Clock::processor))};
}

}  // namespace sinew::bench
