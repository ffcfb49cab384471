// Life: limits of the range, Palmgren and Miner's sum, the interval of counted failures.

#include "sinew/actuator/life.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sinew/actuator/body.h"
#include "sinew/actuator/tension.h"
#include "sinew/actuator/thesis_actuator.h"

namespace sinew::actuator::life_test {
namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();
constexpr Life some{.contraction = 0.2,
                    .cycles_over = 1000,
                    .cycles_under = 5000,
                    .exponent_least = 1,
                    .exponent_most = 4};

TEST(Life, IsTheReferenceAtTheReference) {
  const Bounds n = cycles_of_life(some, 0.2);
  EXPECT_EQ(n.least, 1000);
  EXPECT_EQ(n.most, 5000);
}

TEST(Life, WidensAwayFromTheReference) {
  const Bounds half = cycles_of_life(some, 0.1), twice = cycles_of_life(some, 0.4);
  EXPECT_EQ(half.least, 2000);
  EXPECT_EQ(half.most, 16 * 5000);
  EXPECT_EQ(twice.least, 1000.0 / 16);
  EXPECT_EQ(twice.most, 2500);
}

TEST(Life, FallsWithTheContraction) {
  Bounds last = cycles_of_life(some, 0.01);
  for (double contraction = 0.02; contraction < 0.4; contraction += 0.01) {
    const Bounds n = cycles_of_life(some, contraction);
    EXPECT_LT(n.least, last.least);
    EXPECT_LT(n.most, last.most);
    last = n;
  }
  EXPECT_EQ(cycles_of_life(some, 0).least, unknown);
}

TEST(Life, ABoundAloneStaysOne) {
  Life over = some, under = some;
  over.cycles_under = 0;
  under.cycles_over = 0;
  EXPECT_EQ(cycles_of_life(over, 0.1).least, 2000);
  EXPECT_EQ(cycles_of_life(over, 0.1).most, unknown);
  EXPECT_EQ(cycles_of_life(under, 0.1).least, 0);
  EXPECT_EQ(cycles_of_life(under, 0.1).most, 80000);
  EXPECT_FALSE(has_life({}));
  EXPECT_EQ(cycles_of_life(Life{}, 0.1).least, 0);
  EXPECT_EQ(cycles_of_life(Life{}, 0.1).most, unknown);
}

TEST(Life, AnotherPressureLeavesOneBound) {
  Life pressed = some;
  pressed.pressure = 5e5;
  EXPECT_EQ(cycles_of_life(pressed, 0.2, 5e5).least, 1000);
  EXPECT_EQ(cycles_of_life(pressed, 0.2, 5e5).most, 5000);
  EXPECT_EQ(cycles_of_life(pressed, 0.2, 6e5).least, 0);
  EXPECT_EQ(cycles_of_life(pressed, 0.2, 6e5).most, 5000);
  EXPECT_EQ(cycles_of_life(pressed, 0.2, 4e5).least, 1000);
  EXPECT_EQ(cycles_of_life(pressed, 0.2, 4e5).most, unknown);
  EXPECT_EQ(cycles_of_life(some, 0.2, 9e5).most, 5000);
}

TEST(Life, AFactorOfTheBladderMultiplies) {
  Life latex = some;
  latex.factor_least = latex.factor_most = 24;
  EXPECT_EQ(cycles_of_life(latex, 0.1).least, 24 * cycles_of_life(some, 0.1).least);
  EXPECT_EQ(cycles_of_life(latex, 0.1).most, 24 * cycles_of_life(some, 0.1).most);
}

TEST(Life, DamageIsOneAfterALifeOfEqualCycles) {
  const Bounds n = cycles_of_life(some, 0.15);
  Bounds damage{0, 0};
  for (int i = 0; i < 10; ++i) add_damage(damage, n, 0.1 * n.least);
  EXPECT_NEAR(damage.most, 1, 1e-12);
  EXPECT_NEAR(damage.least, n.least / n.most, 1e-12);
}

TEST(Life, DamageOfUnknownBoundsIsUnknown) {
  Bounds damage{0, 0};
  add_damage(damage, {}, 0);
  EXPECT_EQ(damage.most, 0);
  add_damage(damage, {}, 1);
  EXPECT_EQ(damage.least, 0);
  EXPECT_EQ(damage.most, unknown);
}

TEST(Life, SurvivalIsThatOfEachMultiplied) {
  const Bounds n{1000, 5000}, one = survival(n, 1, 100), eight = survival(n, 8, 100);
  EXPECT_NEAR(one.least, std::exp(-0.1), 1e-15);
  EXPECT_NEAR(eight.least, std::pow(one.least, 8), 1e-12);
  EXPECT_NEAR(eight.most, std::pow(one.most, 8), 1e-12);
  EXPECT_EQ(survival({}, 8, 100).least, 0);
  EXPECT_EQ(survival({}, 8, 100).most, 1);
  EXPECT_EQ(survival(n, 8, 0).least, 1);
}

TEST(Life, HoursFollowFromFrequencyAndDuty) {
  EXPECT_EQ(time_of_life({1000, 5000}, 0.5).least, 2000);
  EXPECT_EQ(time_of_life({1000, 5000}, 0.5, 0.25).most, 40000);
}

// Exact Poisson limits, as in tables: 0.6187 and 8.7673 for 3 events, 3.6889 for none, both 95 %.
TEST(Life, CountedFailuresHaveThePoissonInterval) {
  const Bounds n = life_from_failures(3, 1600);
  EXPECT_NEAR(1600 / n.most, 0.6187, 5e-5);
  EXPECT_NEAR(1600 / n.least, 8.7673, 5e-5);
  EXPECT_NEAR(1600 / life_from_failures(0, 1600).least, 3.6889, 5e-5);
  EXPECT_EQ(life_from_failures(0, 1600).most, unknown);
}

// --- the bladder's fit ---

Actuator with_wall_and_threshold() {
  Actuator a = thesis_actuator();
  a.bladder = {.stiffness = 400,
               .rest_length = 0.07,
               .quadratic = 900,
               .saturating_tension = 3,
               .saturation_length = 0.002};
  a.effectiveness.threshold = 3e4;
  a.wall.thickness = 5e-4;
  return a;
}

TEST(Fit, AStretchedBladderStaysAsItIs) {
  Actuator a = with_wall_and_threshold();
  loosen(a);
  EXPECT_EQ(a.bladder.stiffness, 400);
  EXPECT_EQ(a.effectiveness.threshold, 3e4);
  EXPECT_EQ(a.wall.thickness, 5e-4);
}

// Without pressure a loose bladder has no tension at any length; its mesh pulls at any pressure.
TEST(Fit, ALooseBladderHasNoTensionAndNoThreshold) {
  Actuator a = with_wall_and_threshold();
  a.bladder.fit = Bladder::Fit::oversized;
  loosen(a);
  for (const double length : {0.065, 0.07, 0.08, 0.09})
    EXPECT_EQ(tension(a, length, 0, 0, 1e5), 0) << length;
  EXPECT_GT(tension(a, 0.09, 0, 1000, 1e5), 0);
  EXPECT_EQ(a.wall.thickness, 5e-4);
}

// With a liner the law is that of the mesh: the work of the tension is that of the braid's volume.
TEST(Fit, ALinerLeavesTheMeshAlone) {
  Actuator a = with_wall_and_threshold();
  a.bladder.fit = Bladder::Fit::liner;
  loosen(a);
  Actuator mesh = thesis_actuator();
  mesh.bladder = {};
  for (const double length : {0.065, 0.07, 0.08, 0.09}) {
    EXPECT_EQ(tension(a, length, 0, 2e5, 1e5), tension(mesh, length, 0, 2e5, 1e5)) << length;
    EXPECT_EQ(volume(a, length), volume(mesh.braid, length)) << length;
  }
}

}  // namespace
}  // namespace sinew::actuator::life_test
