// Many runs in lanes: each equals the run by itself, bit for bit, independent of the others.
#include "sinew/run/simulation/lanes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <stdexcept>

#include "sinew/run/setup/machine_setup.h"
#include "sinew/run/simulation/test_same.h"
#include "sinew/world/batch.h"
#include "tests/places.h"

namespace sinew::run::lanes_test {
namespace {

using experiment::Experiment;

const std::string source = sinew::test::source_dir();

// Experiments that can run in lanes: walks, legs in the air, on a fixed base, with faulty sensors
// or pressure sensors, with other periods or steps; and some that cannot.
Experiment random_experiment(std::mt19937& random) {
  const char* files[] = {"walk-test-1",
                         "walk-test-2",
                         "leg-in-air",
                         "kick",
                         "pwm-80",
                         "pwm-151",
                         "touchdown",
                         "derivative-control",
                         "walk-with-pressures",
                         "joint-limits",
                         "blocked-joint",
                         "knee-staircase",
                         "faults/sensor-open",
                         "faults/valve-stuck-open",
                         "walk-with-hoses",
                         "endurance"};
  const std::string file = files[random() % std::size(files)];
  const auto number = [&](double low, double high) {
    return std::to_string(std::uniform_real_distribution<double>(low, high)(random));
  };
  std::vector<std::string> sets = {
      "seed=" + std::to_string(random() % 1000),
      "joint.hip.angle_gain=" + number(0.02, 0.1) + " %/count",
      "plant_steps.body=" + std::string(random() % 3 ? "1 ms" : "0.7 ms"),
      "log.period=" + std::string(random() % 4 ? "10 ms" : "3 ms")};
  if (random() % 2) sets.push_back("air.polytropic_exponent=" + number(1.0, 1.4));
  sets.push_back("sequence.repeat=1");
  return experiment::load(source + "/experiments/" + file + ".toml", sets);
}

void expect_same_outcome(const Outcome& a, const Outcome& b) {
  ASSERT_NO_FATAL_FAILURE(expect_same(a.table, b.table));
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.nodes, b.nodes);
  EXPECT_EQ(a.took_air, b.took_air);
  EXPECT_EQ(a.duration, b.duration);
  EXPECT_EQ(a.no_room, b.no_room);
  EXPECT_EQ(a.unreachable_periods, b.unreachable_periods);
  EXPECT_EQ(a.failure.of, b.failure.of);
  EXPECT_EQ(a.failure.time, b.failure.time);
  EXPECT_EQ(a.controller.phase, b.controller.phase);
  EXPECT_EQ(a.controller.invalid, b.controller.invalid);
  EXPECT_EQ(a.controller.overruns, b.controller.overruns);
  EXPECT_EQ(a.supervised.rejected, b.supervised.rejected);
  EXPECT_EQ(a.supervised.trip.cause, b.supervised.trip.cause);
  EXPECT_EQ(a.supervised.trip.at, b.supervised.trip.at);
}

// Runs them in lanes, and records these topics (nullptr: all); returns the outcomes in their order.
std::vector<Outcome> in_lanes(const std::vector<Experiment>& each, int most,
                              const signals::TopicNames* topics = nullptr) {
  std::vector<Outcome> out(each.size());
  std::size_t next = 0;
  run_in_lanes({.next = [&] { return next < each.size() ? &each[next++] : nullptr; },
                .done =
                    [&](const Experiment& e, Outcome outcome, const std::exception_ptr& thrown) {
                      EXPECT_FALSE(thrown);
                      out[static_cast<std::size_t>(&e - each.data())] = std::move(outcome);
                    },
                .most = most,
                .topics = [&](const Experiment&) { return topics; }});
  return out;
}

TEST(Lanes, RunsSideBySideHaveTheBitsThatTheyHaveAlone) {
  std::mt19937 random(7);
  std::vector<Experiment> each;
  std::vector<Outcome> alone;
  int held = 0;
  for (int i = 0; i < 24; ++i) {
    each.push_back(random_experiment(random));
    alone.push_back(run(each.back()));
    held += plant::Batch::fits(planar_setup(each.back()));
  }
  EXPECT_GT(held, 12);
  EXPECT_LT(held, 24);
  for (const int most : {1, 2, 4, 8}) {
    const std::vector<Outcome> lanes = in_lanes(each, most);
    for (std::size_t i = 0; i < each.size(); ++i)
      ASSERT_NO_FATAL_FAILURE(expect_same_outcome(lanes[i], alone[i]))
          << each[i].path << ", of " << most << " lanes";
  }
  // Another order, other neighbours.
  std::vector<std::size_t> order(each.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), random);
  std::vector<Experiment> shuffled;
  for (const std::size_t i : order) shuffled.push_back(each[i]);
  const std::vector<Outcome> lanes = in_lanes(shuffled, 8);
  for (std::size_t i = 0; i < order.size(); ++i)
    ASSERT_NO_FATAL_FAILURE(expect_same_outcome(lanes[i], alone[order[i]])) << shuffled[i].path;
}

// Positions and rates are not computed with the other true values if these are not recorded.
TEST(Lanes, TrueMotionRecordedByItselfIsThatOfAllTrueValues) {
  const signals::TopicNames motion = {"/true/trolley/position", "/true/trolley/velocity",
                                      "/true/joint/hip/angle", "/true/joint/knee/velocity"};
  std::mt19937 random(8);
  std::vector<Experiment> each;
  for (int i = 0; i < 12; ++i) each.push_back(random_experiment(random));
  const std::vector<Outcome> lanes = in_lanes(each, 8, &motion);
  std::size_t compared = 0;
  for (std::size_t i = 0; i < each.size(); ++i) {
    signals::Table alone = run(each[i]).table;
    ASSERT_EQ(alone.series.size(), lanes[i].table.series.size()) << each[i].path;
    for (std::size_t s = 0; s < alone.series.size(); ++s) {
      if (!motion.contains(alone.series[s].topic.name)) alone.series[s] = lanes[i].table.series[s];
      compared += motion.contains(alone.series[s].topic.name);
    }
    ASSERT_NO_FATAL_FAILURE(expect_same(lanes[i].table, alone)) << each[i].path;
  }
  EXPECT_GT(compared, 24u);
}

// A machine that diverges ends its own run, as it does by itself.
TEST(Lanes, AFailureIsOneRunsOwn) {
  const std::string file = source + "/experiments/walk-test-1.toml";
  std::vector<Experiment> each;
  for (const char* stiffness : {"3", "1e8", "4", "5"})
    each.push_back(experiment::load(
        file, {"sequence.repeat=1",
               std::string("muscle.knee_extensor.bladder_stiffness=") + stiffness + " N/m"}));
  const std::vector<Outcome> lanes = in_lanes(each, 8);
  EXPECT_TRUE(lanes[1].failure);
  for (std::size_t i = 0; i < each.size(); ++i) {
    EXPECT_EQ(lanes[i].ended_early(), i == 1) << i;
    ASSERT_NO_FATAL_FAILURE(expect_same_outcome(lanes[i], run(each[i]))) << i;
  }
}

TEST(Lanes, FewerThanThereAreLanes) {
  const std::vector<Experiment> one = {
      experiment::load(source + "/experiments/kick.toml", {"sequence.repeat=1"})};
  expect_same_outcome(in_lanes(one, 8)[0], run(one[0]));
  EXPECT_TRUE(in_lanes({}, 8).empty());
}

}  // namespace
}  // namespace sinew::run::lanes_test
