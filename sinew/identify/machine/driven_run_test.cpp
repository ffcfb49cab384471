#include "sinew/identify/machine/driven_run.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sinew/identify/machine/machine_numbers.h"
#include "sinew/identify/machine/test_runs.h"

namespace sinew::identify::driven_run_test {
namespace {

// For the machine that was run, every reading is its mean plus the sensor's noise.
TEST(DrivenRun, LeavesTheSensorsNoiseAlone) {
  for (const char* name : {"one-joint", "leg-in-air", "walk-test-1", "walk-with-pressures"}) {
    const experiment::Experiment e = shipped(name);
    const DrivenRun driven(e, recorded(e), false);
    std::vector<double> mean(driven.samples());
    ASSERT_TRUE(driven.predict(e, mean, driven.duration()));
    std::size_t s = 0;
    for (const RunChannel& c : driven.channels()) {
      double squares = 0, sum = 0;
      for (const double value : c.value) {
        const double left = (value - mean[s++]) / c.noise;
        squares += left * left;
        sum += left;
      }
      const auto n = static_cast<double>(c.value.size());
      // Converter limits clip the noise, and a constant reading has none.
      EXPECT_LT(std::sqrt(squares / n), 1 + 4 / std::sqrt(2 * n)) << name << " " << c.name;
      EXPECT_LT(std::abs(sum), 4.5 * std::sqrt(n)) << name << " " << c.name;
    }
    EXPECT_EQ(s, driven.samples());
  }
}

// The mean of a clipped reading: half of a normal distribution above 0 has the mean 1/sqrt(2 pi).
TEST(RunChannel, CutsNoiseAtTheConvertersEnds) {
  RunChannel c{.at_zero = 10, .per_unit = 2, .noise = 0.5, .bottom = 0, .top = 4095};
  const double half = 0.5 / std::sqrt(2 * 3.14159265358979);
  EXPECT_NEAR(c.expected(-5), half, 1e-12);
  EXPECT_NEAR(c.expected(0.5 * (4095 - 10)), 4095 - half, 1e-9);
  EXPECT_NEAR(c.expected(-100), 0, 1e-12);
  EXPECT_NEAR(c.expected(3000), 4095, 1e-12);
  EXPECT_EQ(c.expected(100), 210);
}

// Parallel simulations give the same bits.
TEST(DrivenRun, ChangesWithTheMachinesNumbers) {
  experiment::Experiment e = shipped("one-joint");
  const DrivenRun driven(e, recorded(e), false);
  std::vector<double> at(driven.samples()), more(driven.samples()), again(driven.samples());
  ASSERT_TRUE(driven.predict(e, at, driven.duration()));
  set_number(e, "joint.lever.damping", 0.06);
  ASSERT_TRUE(driven.predict(e, more, driven.duration()));
  ASSERT_TRUE(driven.predict(e, again, driven.duration()));
  EXPECT_NE(at, more);
  EXPECT_EQ(more, again);
}

TEST(MachineNumbers, GroupsAreOfTheRobotsKeys) {
  experiment::Experiment e = shipped("one-joint");
  EXPECT_EQ(machine_keys(e, {"friction", "damping"}),
            (std::vector<std::string>{"joint.lever.dry_friction", "joint.lever.damping"}));
  EXPECT_EQ(
      machine_keys(e, {"dead-time"}),
      (std::vector<std::string>{"valve.inlet.opening_delay", "valve.inlet.closing_delay",
                                "valve.exhaust.opening_delay", "valve.exhaust.closing_delay"}));
  EXPECT_EQ(machine_keys(e, {}).size(), 10u);
  EXPECT_EQ(machine_keys(e, {"volume", "muscle.flexor.external_volume"}).size(), 2u);
}

TEST(MachineNumbers, ReportsWhichWordIsWrong) {
  experiment::Experiment e = shipped("one-joint");
  EXPECT_EQ(
      refusal([&] { machine_keys(e, {"joint.lever.dampin"}); }),
      "fit: found \"joint.lever.dampin\"; expected a number's key of this robot, or friction, "
      "damping, dead-time, volume, leak; try \"joint.lever.damping\"");
}

}  // namespace
}  // namespace sinew::identify::driven_run_test
