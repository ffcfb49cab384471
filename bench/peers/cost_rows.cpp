// Cost of a machine's size, its steps, its neighbours in lanes and its recorder: each is compared
// with the plain walk, measured alternately.
#include <fmt/format.h>

#include <exception>
#include <string>
#include <vector>

#include "bench/peers/experiments.h"
#include "bench/peers/row.h"
#include "sinew/run/simulation/lanes.h"
#include "sinew/run/simulation/run.h"

namespace sinew::bench {

namespace {

using experiment::Experiment;

// Runs the experiment and returns the simulated time [s].
double simulate(const Experiment& e, bool recorded) {
  return run::run(e, {.recorded = recorded}).duration;
}

Work repeated(const Experiment& e, bool recorded, int times) {
  return [&e, recorded, times] {
    double seconds = 0;
    for (int i = 0; i < times; ++i) seconds += simulate(e, recorded);
    return seconds;
  };
}

Row against_the_walk(Row row, const Experiment& e, int rounds) {
  row.per = "simulated second";
  return times_slower(std::move(row), by_turns(repeated(e, false, 2), repeated(walk(), false, 2),
                                               rounds, Clock::processor));
}

// Adds rows of machines of other sizes.
Row size(const std::string& file, int rounds) {
  const Experiment e = experiment::load(experiment_file(file));
  const std::string name = file.substr(0, file.find('.'));
  return against_the_walk(
      {.name = "cost/" + name,
       .what = fmt::format("{}: {} joints and {} muscles, against the plain "
                           "walk's 2 and 4",
                           e.title, e.robot.joints.size(), e.robot.muscles.size())},
      e, rounds);
}

Row step(double ms, int rounds) {
  Experiment e = walk();
  e.body_step = 1e-3 * ms;
  return against_the_walk(
      {.name = fmt::format("cost/step-{:g}ms", ms),
       .what = fmt::format("the walk by nodes every {:g} ms, against 1 ms", ms)},
      e, rounds);
}

double in_lanes(const std::vector<Experiment>& each, int lanes) {
  std::size_t next = 0;
  run::run_in_lanes(
      {.next = [&] { return next < each.size() ? &each[next++] : nullptr; },
       .done = [](const Experiment&, const run::Outcome&, const std::exception_ptr&) {},
       .most = lanes,
       .recorded = false});
  return static_cast<double>(each.size());
}

Row beside(int lanes, int rounds) {
  Row row{.name = fmt::format("cost/beside-{}", lanes),
          .what = fmt::format("walks, {} side by side on one thread, against one after the other",
                              lanes),
          .per = "walk"};
  if (lanes > 2 && lanes > run::widest_lanes())
    return not_measured(row, "this processor has fewer lanes");
  std::vector<Experiment> each(static_cast<std::size_t>(2 * lanes), walk());
  for (std::size_t i = 0; i < each.size(); ++i) each[i].seed = static_cast<int>(i + 1);
  return times_slower(row, by_turns([&] { return in_lanes(each, lanes); },
                                    [&] { return in_lanes(each, 1); }, rounds, Clock::processor));
}

Row recorder(int rounds) {
  return times_slower(
      {.name = "cost/recorded",
       .what = "the walk with its channel table in memory, against no recording",
       .per = "simulated second"},
      by_turns(repeated(walk(), true, 2), repeated(walk(), false, 2), rounds, Clock::processor));
}

}  // namespace

std::vector<Row> cost_rows(const Effort& effort) {
  std::vector<Row> rows;
  for (const char* file : {"one-joint.toml", "three-muscles.toml", "walk-with-ankle.toml",
                           "walk-two-legs.toml", "walk-with-pressures.toml", "endurance.toml",
                           "walk-with-regulators.toml", "walk-with-hoses.toml"})
    rows.push_back(size(file, effort.rounds));
  for (const double ms : {2.0, 0.5, 0.25}) rows.push_back(step(ms, effort.rounds));
  for (const int lanes : {2, 4, 8}) rows.push_back(beside(lanes, effort.rounds));
  rows.push_back(recorder(effort.rounds));
  return rows;
}

}  // namespace sinew::bench
