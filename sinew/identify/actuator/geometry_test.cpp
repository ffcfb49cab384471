// The thread and turns of a braid are identified from lengths and diameters.
#include "sinew/identify/actuator/geometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sinew/actuator/braid.h"
#include "sinew/identify/contest/refusal.h"

namespace sinew::identify::geometry_test {
namespace {

constexpr actuator::Braid truth{.thread_length = 0.1071372, .turns = 2.3125};

Measured pairs(unsigned seed, double noise, int count, double thickness = 0) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, noise);
  Measured m{.file = "mesh.csv", .columns = {{"length", "m", {}}, {"diameter", "m", {}}}};
  for (int i = 0; i < count; ++i) {
    const double length = 0.065 + 0.03 * i / (count - 1);
    m.columns[0].values.push_back(length);
    m.columns[1].values.push_back(diameter(truth, length) + thickness + normal(random));
    m.lines.push_back(i + 2);
  }
  return m;
}

TEST(Geometry, WithoutNoiseTheBraidComesBack) {
  for (const double thickness : {0.0, 4e-4}) {
    const GeometryResult g = identify_geometry(pairs(1, 0, 5, thickness), thickness);
    EXPECT_NEAR(g.braid.thread_length, truth.thread_length, 1e-9);
    EXPECT_NEAR(g.braid.turns, truth.turns, 1e-7);
  }
}

TEST(Geometry, IntervalsCoverTheTruth) {
  int covered = 0;
  double bias = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const GeometryResult g = identify_geometry(pairs(seed, 5e-5, 10));
    const Estimate& turns = g.report.best().parameters[1];
    covered += turns.low <= truth.turns && truth.turns <= turns.high;
    bias += (turns.value / truth.turns - 1) / 200;
  }
  EXPECT_GE(covered, 180);
  EXPECT_LE(covered, 198);
  EXPECT_LT(std::abs(bias), 0.01);
}

TEST(Geometry, OneWrongDiameterIsReportedAndHasLittleEffect) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    Measured m = pairs(seed, 3e-5, 10);
    m.columns[1].values[seed % 10] *= seed % 2 == 0 ? 1.3 : 0.6;
    const GeometryResult g = identify_geometry(m);
    EXPECT_NEAR(g.braid.thread_length, truth.thread_length, 0.02 * truth.thread_length) << seed;
    EXPECT_NEAR(g.braid.turns, truth.turns, 0.05 * truth.turns) << seed;
    ASSERT_EQ(g.report.warnings.size(), 1u) << seed;
    EXPECT_TRUE(g.report.warnings[0].starts_with("mesh.csv:" + std::to_string(seed % 10 + 2)));
    EXPECT_TRUE(identify_geometry(pairs(seed, 3e-5, 10)).report.warnings.empty());
  }
}

// A caliper measures the outside of the threads, wider than the circle of their centers. Without a
// correction the braid has fewer turns.
TEST(Geometry, TheOutsideTakenForTheMeshLosesTurns) {
  const Measured outside = pairs(1, 0, 8, 5e-4);
  EXPECT_LT(identify_geometry(outside).braid.turns, 0.98 * truth.turns);
  EXPECT_NEAR(identify_geometry(outside, 5e-4).braid.turns, truth.turns, 1e-6);
  EXPECT_THROW(identify_geometry(outside, 0.02), Refusal);
  EXPECT_THROW(identify_geometry(outside, -1e-4), Refusal);
}

TEST(Geometry, TwoPairsAreEnoughAndOneIsNot) {
  const GeometryResult g = identify_geometry(pairs(1, 0, 2));
  EXPECT_NEAR(g.braid.turns, truth.turns, 1e-7);
  EXPECT_TRUE(std::isinf(g.report.best().parameters[0].high)) << "no error can be seen";
  const std::size_t first[] = {0};
  EXPECT_THROW(identify_geometry(pairs(1, 0, 2).subset(first)), Refusal);
}

TEST(Geometry, OneLengthAndSwappedColumnsAreRefused) {
  Measured one = pairs(1, 0, 5);
  for (double& x : one.columns[0].values) x = 0.08;
  EXPECT_THROW(identify_geometry(one), Refusal);

  Measured rising = pairs(1, 0, 5);
  std::reverse(rising.columns[1].values.begin(), rising.columns[1].values.end());
  EXPECT_THROW(identify_geometry(rising), Refusal);

  Measured wild = pairs(1, 0, 6);
  for (std::size_t i = 0; i < 6; ++i) wild.columns[1].values[i] *= i % 2 == 0 ? 1.5 : 0.6;
  EXPECT_THROW(identify_geometry(wild), Refusal);

  // An ellipse of lengths and diameters is also one with exchanged axes, with hardly any turns.
  Measured swapped = pairs(1, 0, 5);
  std::swap(swapped.columns[0].values, swapped.columns[1].values);
  EXPECT_THROW(identify_geometry(swapped), Refusal);
}

}  // namespace
}  // namespace sinew::identify::geometry_test
