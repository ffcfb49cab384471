// The whole closed loop: gait controller, joint controllers, air and body, with actions in every
// period.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>

#include "bench/peers/experiments.h"
#include "bench/peers/mujoco_leg.h"
#include "bench/peers/pair.h"
#include "sinew/run/setup/machine_setup.h"
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

std::map<std::string, double> errors() {
  constexpr int walks = 5;
  const auto ours = [](const Experiment& e) { return our_walk(e); };
  const auto theirs = [](const Experiment& e) { return their_walk(e); };
  const auto theirs_finer = [](const Experiment& e) {
    return their_walk(e, {.body = 1, .muscle = 4});
  };
  const double a = mean_way(ours, 1e-3, walks), b = mean_way(theirs, 1e-3, walks);
  return {{"our_distance_in", a},
          {"our_error_in", std::fabs(a - mean_way(ours, 1e-4, walks))},
          {"their_distance_in", b},
          {"their_error_in", std::fabs(b - mean_way(theirs_finer, 1e-3, walks))}};
}

const Registration rows([] {
  benchmark::AddCustomContext("mujoco", mujoco_version());
  const auto theirs = [] {
    their_walk(walk());
    return 1.0;
  };
  compare("walk/mujoco-pow", [theirs] {
    const auto ours = [each = walks(2)] {
      for (int i = 0; i < 8; ++i) our_walk(each[static_cast<std::size_t>(i % 2)]);
      return 8.0;
    };
    return Pair{.ours = ours,
                .theirs = theirs,
                .label =
                    "test 1 with its controller, contacts on, no recording, against MuJoCo "
                    "(Euler, 1 ms) with scalar pow RK4 muscles (100 us)",
                .figures = errors()};
  });
  compare("walk/mujoco-pow-lanes", [theirs] {
    const int lanes = run::widest_lanes();
    return Pair{.ours = [each = walks(2 * lanes), lanes] { return in_lanes(each, lanes, false); },
                .theirs = theirs,
                .label = "the same, ours in the processor's lanes on one thread"};
  });
});

}  // namespace

}  // namespace sinew::bench
