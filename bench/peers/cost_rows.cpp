// Cost of a machine's size, its steps and its recorder, each compared with the plain walk.
#include <fmt/format.h>

#include <string>

#include "bench/peers/experiments.h"
#include "bench/peers/pair.h"
#include "sinew/run/simulation/run.h"

namespace sinew::bench {

namespace {

using experiment::Experiment;

// Runs the experiment twice and returns the simulated time [s].
Work simulated(const Experiment& e, bool recorded) {
  return [e, recorded] {
    double seconds = 0;
    for (int i = 0; i < 2; ++i) seconds += run::run(e, {.recorded = recorded}).duration;
    return seconds;
  };
}

Pair against_the_walk(const Experiment& e, bool recorded, const std::string& label) {
  return {.ours = simulated(e, recorded), .theirs = simulated(walk(), false), .label = label};
}

const Registration rows([] {
  for (const std::string name :
       {"one-joint", "three-muscles", "walk-with-ankle", "walk-two-legs", "walk-with-pressures",
        "endurance", "walk-with-regulators", "walk-with-hoses", "cylinder-staircase"})
    compare("cost/" + name, [name] {
      const Experiment e = experiment::load(experiment_file(name + ".toml"));
      return against_the_walk(e, false,
                              fmt::format("{}: {} joints and {} muscles", e.title,
                                          e.robot.joints.size(), e.robot.muscles.size()));
    });
  for (const double ms : {2.0, 0.5, 0.25})
    compare(fmt::format("cost/step-{:g}ms", ms), [ms] {
      Experiment e = walk();
      e.body_step = 1e-3 * ms;
      return against_the_walk(e, false, fmt::format("nodes every {:g} ms, against 1 ms", ms));
    });
  compare("cost/recorded",
          [] { return against_the_walk(walk(), true, "channel table in memory, against none"); });
});

}  // namespace

}  // namespace sinew::bench
